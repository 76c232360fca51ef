#include "tumble/sweep/folder.hpp"

#include <array>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "tumble/output/file.hpp"
#include "tumble/scene/limits.hpp"

namespace tumble::sweep {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_spec_name = "spec.toml";
constexpr const char* k_scene_name = "scene.toml";
constexpr const char* k_chunks_name = "chunks";
constexpr std::array<const char*, 5> k_result_names = {k_columns_name, k_statistics_name, k_table_name, k_json_name,
                                                       k_picture_name};

[[noreturn]] void refuse(const fs::path& path, std::string_view why) {
  throw std::invalid_argument(fmt::format("{}: {}", output::path_text(path), why));
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw std::system_error(error, fmt::format("cannot make the folder {}", output::path_text(path)));
}

bool is_unused(const fs::path& path) {
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    const std::string name = entry.path().filename().string();
    // What another process, or one that was killed, has begun with.
    if (name != k_scene_name && !name.starts_with(".tumble-")) return false;
  }
  return true;
}

Spec read_spec(const fs::path& path) {
  const fs::path file = path / k_spec_name;
  return parse_spec(output::read_file(file, k_max_spec_bytes), output::path_text(file),
                    [&](const std::string&) { return output::read_file(path / k_scene_name, k_max_scene_bytes); });
}

// spec.toml last: without it the folder is not that of a sweep.
void write_spec(const fs::path& path, const Spec& spec, bool overwrite) {
  try {
    if (spec.scene) output::write_file_atomically(path / k_scene_name, spec.scene->text, true);
    output::write_file_atomically(path / k_spec_name, spec.text, overwrite);
  } catch (const std::invalid_argument&) {
    if (!fs::exists(path / k_spec_name)) throw;  // else another shard was first
  }
}

}  // namespace

Folder::Folder(fs::path path, Spec spec)
    : path_(std::move(path)), spec_(std::move(spec)), fingerprint_(fingerprint(spec_)) {}

Folder Folder::begin(const fs::path& path, const Spec& spec, bool overwrite) {
  if (fs::exists(path) && !fs::is_directory(path)) refuse(path, "is no folder");
  make_folder(path);
  const fs::path file = path / k_spec_name;
  if (!fs::exists(file)) {
    if (!is_unused(path)) refuse(path, "is a folder with other things than a sweep in it");
    write_spec(path, spec, false);
  }
  Folder folder(path, spec);
  if (fingerprint(read_spec(path)) != folder.fingerprint_) {
    if (!overwrite) refuse(path, "holds another sweep: its spec.toml gives other results. --force empties the folder");
    folder.remove_results();
    write_spec(path, spec, true);
  }
  make_folder(path / k_chunks_name);
  return folder;
}

Folder Folder::open(const fs::path& path) {
  if (!fs::exists(path / k_spec_name)) refuse(path, "is no folder of a sweep: it has no spec.toml");
  return {path, read_spec(path)};
}

fs::path Folder::chunk_path(std::uint64_t chunk) const {
  return path_ / k_chunks_name / fmt::format("{:06}.chunk", chunk);
}

void Folder::remove_results() const {
  std::error_code error;
  fs::remove_all(path_ / k_chunks_name, error);
  if (error) {
    refuse(path_ / k_chunks_name,
           fmt::format("cannot be removed ({}); is another process at work in it?", error.message()));
  }
  for (const char* name : k_result_names) fs::remove(path_ / name);
}

void Folder::remove() const {
  remove_results();
  fs::remove(path_ / k_scene_name);
  fs::remove(path_ / k_spec_name);
  std::error_code is_not_empty;
  fs::remove(path_, is_not_empty);
}

}  // namespace tumble::sweep
