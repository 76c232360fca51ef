// Scenes as TOML files: the format is in docs/scenes.md.
#pragma once

#include <string>
#include <string_view>

#include "tumble/scene/scene.hpp"

namespace tumble {

// Reads a scene. Throws std::invalid_argument "<name>:<line>:<column>: <field>: <what is allowed>, <what is there>",
// one line, for text that is no TOML, unknown keys, values out of range and all else that `validate` refuses. `name`
// stands for the text in those messages, usually the file's name. Columns count characters.
Scene parse_scene(std::string_view text, const std::string& name = "scene");

// The text of a scene, which `parse_scene` reads back to an equal scene, bit for bit. Throws what `validate` throws.
std::string to_toml(const Scene& scene);

}  // namespace tumble
