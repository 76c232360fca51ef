// The folder that a sweep works in: spec.toml, scene.toml if it sweeps a scene, and in chunks/ a file for each chunk
// that is finished. It may be used by several processes at once, and each file in it appears only when it is complete.
#pragma once

#include <cstdint>
#include <filesystem>

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
  // Makes the folder, or goes on with it if its spec gives the same results. Throws std::invalid_argument if it holds
  // another sweep (which `overwrite` empties instead) or other things, std::system_error if it cannot be made.
  static Folder begin(const std::filesystem::path& path, const Spec& spec, bool overwrite);

  // That of a sweep which was begun. Throws std::invalid_argument if it is not.
  static Folder open(const std::filesystem::path& path);

  const Spec& spec() const { return spec_; }
  std::uint64_t spec_fingerprint() const { return fingerprint_; }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path chunk_path(std::uint64_t chunk) const;

  // Removes chunks and results.
  void remove_results() const;

  // Removes what `begin` and chunks have made of it, and itself if nothing else is in it.
  void remove() const;

 private:
  Folder(std::filesystem::path path, Spec spec);

  std::filesystem::path path_;
  Spec spec_;
  std::uint64_t fingerprint_;
};

}  // namespace tumble::sweep
