// The folder that a sweep works in: spec.toml, scene.toml if it sweeps a scene, and in chunks/ a file for each chunk
// that is finished. Several processes may compute in it at once, and each file in it appears only when it is complete.
// Who works in it holds a lock on spec.toml: a shared one, or an exclusive one to take away what others may need.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "tumble/sweep/file_lock.hpp"
#include "tumble/sweep/spec.hpp"

namespace tumble::sweep {

// What the folder holds in the end.
inline constexpr const char* k_columns_name = "columns.npz";
inline constexpr const char* k_statistics_name = "statistics.npz";
inline constexpr const char* k_table_name = "summary.csv";
inline constexpr const char* k_json_name = "summary.json";
inline constexpr const char* k_picture_name = "overview.png";

class Folder {
 public:
  enum class Use {
    shared,  // others may compute in it, too
    alone,   // no other process may, so that `remove` is allowed
  };

  // Makes the folder, or goes on with it if its spec gives the same results. Throws std::invalid_argument if it holds
  // another sweep (whose chunks and results `overwrite` removes instead) or other things, std::system_error if it
  // cannot be made, std::runtime_error if another process is at work in it: with Use::alone, or where there is
  // something to remove.
  static Folder begin(const std::filesystem::path& path, const Spec& spec, bool overwrite, Use use = Use::shared);

  // That of a sweep which was begun. Throws std::invalid_argument if it is not, std::runtime_error if another process
  // has it alone.
  static Folder open(const std::filesystem::path& path);

  // As `open`, for a process that works for the one that has begun it and holds the lock for both.
  static Folder open_for_helper(const std::filesystem::path& path);

  const Spec& spec() const { return spec_; }
  std::uint64_t spec_fingerprint() const { return fingerprint_; }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path chunk_path(std::uint64_t chunk) const;

  // Removes what `begin` and chunks have made of it, and itself if nothing else is in it. Needs Use::alone.
  void remove() const;

 private:
  Folder(std::filesystem::path path, Spec spec, std::optional<FileLock> lock);

  std::filesystem::path path_;
  Spec spec_;
  std::uint64_t fingerprint_;
  std::optional<FileLock> lock_;
};

}  // namespace tumble::sweep
