// From and to JavaScript.
#pragma once

#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <emscripten/bind.h>
#include <emscripten/val.h>

#include "tumble/math/format.hpp"
#include "tumble/math/pose.hpp"
#include "tumble/math/vector.hpp"
#include "tumble/output/field.hpp"

namespace tumble::wasm {

using emscripten::val;

// Not inlined: each call would be a copy of val::set.
[[gnu::noinline]] inline void set(val& object, const char* name, const val& value) { object.set(name, value); }
[[gnu::noinline]] inline void set(val& object, const char* name, double value) { object.set(name, value); }
[[gnu::noinline]] inline void set(val& object, const char* name, const std::string& value) { object.set(name, value); }

// A typed array of its own memory.
template <class Number>
val to_typed_array(const std::vector<Number>& values) {
  return val(emscripten::typed_memory_view(values.size(), values.data())).template call<val>("slice");
}

template <class Value>
val to_array(const std::vector<Value>& values) {
  val array = val::array();
  for (std::size_t i = 0; i < values.size(); ++i) array.set(i, values[i]);
  return array;
}

inline val to_array(const Vector3& v) { return to_array(std::vector<double>(v.begin(), v.end())); }
inline val to_array(Vector2 v) { return to_array(std::vector<double>{v.x, v.y}); }

// {name: values}; whole numbers of 64 bits become doubles, single values and texts are not arrays.
inline val to_object(const std::vector<output::Field>& fields) {
  val object = val::object();
  for (const output::Field& field : fields) {
    const bool is_scalar = field.shape.empty();
    std::visit(
        [&](const auto& values) {
          using Value = typename std::decay_t<decltype(values)>::value_type;
          if constexpr (std::is_same_v<Value, std::string>) {
            set(object, field.name.c_str(), is_scalar ? val(values.front()) : to_array(values));
          } else if constexpr (std::is_same_v<Value, std::int64_t>) {
            const std::vector<double> doubles(values.begin(), values.end());
            set(object, field.name.c_str(), is_scalar ? val(doubles.front()) : to_typed_array(doubles));
          } else {
            set(object, field.name.c_str(), is_scalar ? val(values.front()) : to_typed_array(values));
          }
        },
        field.values);
  }
  return object;
}

// The number under a name. Throws std::invalid_argument for anything else.
inline double number_at(const val& object, const std::string& name) {
  const val value = object[name];
  if (value.isNumber()) return value.as<double>();
  throw std::invalid_argument(tumble::format("{}: must be a number", name));
}

inline Vector3 triple_at(const val& object, const std::string& name) {
  const val array = object[name];
  if (!array.isArray() || array["length"].as<int>() != 3)
    throw std::invalid_argument(tumble::format("{}: must be three numbers", name));
  Vector3 result{};
  for (std::size_t i = 0; i < 3; ++i) {
    const val value = array[i];
    if (!value.isNumber()) throw std::invalid_argument(tumble::format("{}: must be three numbers", name));
    result[i] = value.as<double>();
  }
  return result;
}

// What `make` returns, or {error: text}: a C++ exception would arrive in JavaScript as a number.
val guarded_call(val (*make)(void*), void* closure);

template <class Make>
val guarded(Make make) {
  return guarded_call([](void* closure) { return (*static_cast<Make*>(closure))(); }, &make);
}

}  // namespace tumble::wasm
