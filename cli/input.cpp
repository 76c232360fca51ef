#include "input.hpp"

#include "tumble/output/file.hpp"
#include "tumble/scene/limits.hpp"
#include "tumble/scene/scene_toml.hpp"

namespace tumble::cli {

std::string input_name(const std::string& file) { return file == "-" ? "standard input" : output::path_text(file); }

std::string read_input(const std::string& file, std::size_t max_bytes) {
  return output::read_file(file == "-" ? "/dev/stdin" : file, max_bytes);
}

Scene read_scene(const std::string& file) { return parse_scene(read_input(file, k_max_scene_bytes), input_name(file)); }

}  // namespace tumble::cli
