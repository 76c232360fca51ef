#include "input.hpp"

#include <cstdlib>
#include <system_error>

#include "tumble/output/file.hpp"
#include "tumble/scene/limits.hpp"
#include "tumble/scene/scene_toml.hpp"

namespace tumble::cli {

std::string input_name(const std::string& file) { return file == "-" ? "standard input" : output::path_text(file); }

std::string read_input(const std::string& file, std::size_t max_bytes) {
  return output::read_file(file == "-" ? "/dev/stdin" : file, max_bytes);
}

Scene read_scene(const std::string& file) { return parse_scene(read_input(file, k_max_scene_bytes), input_name(file)); }

std::filesystem::path page_path() {
  const char* named = std::getenv("TUMBLE_PAGE");
  if (named != nullptr && *named != '\0') return named;
  std::error_code ignored;  // without /proc, an empty path: a page that cannot be read
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return program.parent_path().parent_path() / "share/tumble/tumble.html";
}

}  // namespace tumble::cli
