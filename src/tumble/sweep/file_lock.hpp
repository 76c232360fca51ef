// A lock on a file, for processes that share a folder. It is advisory, flock(2), and gone whatever ends the process.
#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace tumble::sweep {

class FileLock {
 public:
  enum class Kind {
    shared,     // with other shared ones
    exclusive,  // with none
  };

  // Does not wait: nothing if another lock is in the way, of this process or of any, and if the file has gone or was
  // replaced. On a file system without locks it is in nobody's way. Throws std::system_error with path and reason if
  // the file cannot be opened, for reading or, of an exclusive one, for writing.
  static std::optional<FileLock> try_lock(const std::filesystem::path& path, Kind kind);

  FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace tumble::sweep
