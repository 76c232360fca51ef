// The files of scenes/.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tumble/scene/scene_toml.hpp"

namespace tumble::physics {

inline std::filesystem::path scenes_folder() { return std::filesystem::path(TUMBLE_SOURCE) / "scenes"; }

// Without the suffix, sorted.
inline std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(scenes_folder())) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

inline Scene named_scene(const std::string& name) {
  std::ifstream file(scenes_folder() / (name + ".toml"), std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return parse_scene(text.str(), name + ".toml");
}

}  // namespace tumble::physics
