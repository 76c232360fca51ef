#include "tumble/sweep/folder.hpp"

#include <array>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "tumble/math/format.hpp"
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
  throw std::invalid_argument(tumble::format("{}: {}", output::path_text(path), why));
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw std::system_error(error, tumble::format("cannot make the folder {}", output::path_text(path)));
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

bool is_of(const fs::path& path, const Spec& spec) { return fingerprint(read_spec(path)) == fingerprint(spec); }

// spec.toml last: without it the folder is not that of a sweep.
void write_spec(const fs::path& path, const Spec& spec, bool overwrite) {
  try {
    if (spec.scene) output::write_file_atomically(path / k_scene_name, spec.scene->text, true);
    output::write_file_atomically(path / k_spec_name, spec.text, overwrite);
  } catch (const std::invalid_argument&) {
    if (!fs::exists(path / k_spec_name)) throw;  // else another shard was first
  }
}

void remove_results(const fs::path& path) {
  std::error_code error;
  fs::remove_all(path / k_chunks_name, error);
  if (error) refuse(path / k_chunks_name, tumble::format("cannot be removed: {}", error.message()));
  for (const char* name : k_result_names) fs::remove(path / name);
}

// In place of another sweep; false if a process is at work in that.
bool replace_sweep(const fs::path& path, const Spec& spec) {
  const std::optional<FileLock> lock = FileLock::try_lock(path / k_spec_name, FileLock::Kind::exclusive);
  if (!lock) return false;
  if (is_of(path, spec)) return true;  // another process was first
  remove_results(path);
  write_spec(path, spec, true);
  return true;
}

// A lock on the folder of this sweep, which is made if there is none; nothing if another lock is in the way.
std::optional<FileLock> try_begin(const fs::path& path, const Spec& spec, bool overwrite, FileLock::Kind kind) {
  make_folder(path);
  const fs::path file = path / k_spec_name;
  if (!fs::exists(file)) {
    if (!is_unused(path)) refuse(path, "is a folder with other things than a sweep in it");
    write_spec(path, spec, false);
  }
  std::optional<FileLock> lock = FileLock::try_lock(file, kind);
  if (!lock || is_of(path, spec)) return lock;
  if (!overwrite) refuse(path, "holds another sweep: its spec.toml gives other results");
  lock.reset();  // of two processes that keep a shared one, none would get an exclusive one
  return replace_sweep(path, spec) ? try_begin(path, spec, overwrite, kind) : std::nullopt;
}

// For locks that are in the way.
class Patience {
 public:
  // More than it takes to remove the 10^4 chunks of a large sweep; one that computes is not waited for.
  static constexpr std::chrono::milliseconds k_usual{2000};

  explicit Patience(std::chrono::milliseconds time = k_usual) : end_(std::chrono::steady_clock::now() + time) {}

  void wait(const fs::path& path) const {
    if (std::chrono::steady_clock::now() >= end_) {
      throw std::runtime_error(
          tumble::format("{}: another process is at work in this folder", output::path_text(path)));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }

 private:
  std::chrono::steady_clock::time_point end_;
};

void require_sweep(const fs::path& path) {
  if (!fs::exists(path / k_spec_name)) refuse(path, "is no folder of a sweep: it has no spec.toml");
}

}  // namespace

Folder::Folder(fs::path path, Spec spec, std::optional<FileLock> lock)
    : path_(std::move(path)), spec_(std::move(spec)), fingerprint_(fingerprint(spec_)), lock_(std::move(lock)) {}

Folder Folder::begin(const fs::path& path, const Spec& spec, bool overwrite, Use use) {
  const bool is_alone = use == Use::alone;
  if (fs::exists(path) && !fs::is_directory(path)) refuse(path, "is no folder");
  for (const Patience patience(is_alone ? std::chrono::milliseconds(0) : Patience::k_usual);; patience.wait(path)) {
    std::optional<FileLock> lock =
        try_begin(path, spec, overwrite, is_alone ? FileLock::Kind::exclusive : FileLock::Kind::shared);
    if (!lock) continue;
    make_folder(path / k_chunks_name);
    return {path, spec, std::move(lock)};
  }
}

Folder Folder::open(const fs::path& path) {
  for (const Patience patience;; patience.wait(path)) {
    require_sweep(path);
    std::optional<FileLock> lock = FileLock::try_lock(path / k_spec_name, FileLock::Kind::shared);
    if (lock) return {path, read_spec(path), std::move(lock)};
  }
}

Folder Folder::open_for_helper(const fs::path& path) {
  require_sweep(path);
  return {path, read_spec(path), std::nullopt};
}

fs::path Folder::chunk_path(std::uint64_t chunk) const {
  return path_ / k_chunks_name / tumble::format("{:06}.chunk", chunk);
}

void Folder::remove() const {
  remove_results(path_);
  fs::remove(path_ / k_scene_name);
  fs::remove(path_ / k_spec_name);
  std::error_code is_not_empty;
  fs::remove(path_, is_not_empty);
}

}  // namespace tumble::sweep
