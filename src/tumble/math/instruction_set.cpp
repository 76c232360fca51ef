#include "tumble/math/instruction_set.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "tumble/math/format.hpp"

namespace tumble {
std::string_view to_string(InstructionSet set) {
  switch (set) {
    case InstructionSet::scalar: return "scalar";
    case InstructionSet::avx2: return "avx2";
    case InstructionSet::avx512: return "avx512";
    case InstructionSet::baseline: break;
  }
#if defined(__EMSCRIPTEN__)
  return "simd128";
#elif defined(__aarch64__)
  return "neon";
#elif defined(__x86_64__)
  return "sse2";
#else
  return "vectors";
#endif
}

bool has_instruction_set(InstructionSet set) {
#if TUMBLE_HAS_X86_SETS
  if (set == InstructionSet::avx512) return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2");
#endif
  return set == InstructionSet::scalar || set == InstructionSet::baseline;
}

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const auto set :
       {InstructionSet::scalar, InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (has_instruction_set(set)) sets.push_back(set);
  }
  return sets;
}

InstructionSet instruction_set_named(std::string_view name, std::string_view field) {
  std::string names;
  for (const InstructionSet set : instruction_sets()) {
    if (name == to_string(set)) return set;
    names += (names.empty() ? "" : ", ") + std::string(to_string(set));
  }
  throw std::invalid_argument(tumble::format("{}: must be one of {} on this machine, got '{}'", field, names, name));
}

InstructionSet instruction_set() {
  const char* name = std::getenv("TUMBLE_INSTRUCTION_SET");
  if (name != nullptr && *name != '\0') return instruction_set_named(name, "TUMBLE_INSTRUCTION_SET");
  static const InstructionSet widest = instruction_sets().back();
  return widest;
}

}  // namespace tumble
