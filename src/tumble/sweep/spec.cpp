#include "tumble/sweep/spec.hpp"

#include "tumble/math/format.hpp"
#include "tumble/scene/scene_toml.hpp"

namespace tumble::sweep {
namespace {

struct SourceText {
  std::string operator()(const Constant& source) const { return tumble::format("{:a}", source.value); }
  std::string operator()(const Grid& source) const { return "grid " + tumble::join(source.values, " ", "{:a}"); }
  std::string operator()(const Uniform& source) const {
    return tumble::format("uniform {:a} {:a}", source.low, source.high);
  }
  std::string operator()(const Normal& source) const {
    return tumble::format("normal {:a} {:a}", source.mean, source.deviation);
  }
  std::string operator()(const LogUniform& source) const {
    return tumble::format("log_uniform {:a} {:a}", source.low, source.high);
  }
};

}  // namespace

std::uint64_t fingerprint(const Spec& spec) {
  const auto& [rest_speed, x_min, x_max] = spec.measures;
  std::string text = tumble::format("tumble {}; seed {}; samples {}; chunk {}; keep {}; columns {}; {:a} {:a} {:a}\n",
                                    TUMBLE_VERSION, spec.seed, spec.samples, spec.chunk, static_cast<int>(spec.keep),
                                    spec.columns, rest_speed, x_min, x_max);
  if (spec.scene) text += tumble::format("scene, body {}\n{}", spec.scene->body, to_toml(spec.scene->scene));
  for (const Quantity& quantity : spec.quantities) {
    text += tumble::format("{} {} {}\n", quantity.name, quantity.draw, std::visit(SourceText{}, quantity.source));
  }
  // FNV-1a [RFC 9923].
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

}  // namespace tumble::sweep
