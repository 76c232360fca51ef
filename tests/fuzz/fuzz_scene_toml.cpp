// libFuzzer: any text is a scene or is refused with one line of std::invalid_argument; a scene reads back from its own
// text, which then does not change.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tumble/scene/scene_toml.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tumble::Scene scene;
  try {
    scene = tumble::parse_scene({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    if (message.rfind("fuzz.toml:", 0) != 0) std::abort();
    for (const char c : message) {
      if (c >= 0 && c < 32) std::abort();
    }
    return 0;
  }
  if (scene.bodies.size() > 1000) return 0;  // copies: slow here, and the same again
  const std::string text = tumble::to_toml(scene);
  if (tumble::to_toml(tumble::parse_scene(text)) != text) std::abort();
  return 0;
}
