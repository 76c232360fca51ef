#include "tumble/sweep/file_lock.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tumble/math/format.hpp"
#include "tumble/output/file.hpp"

namespace tumble::sweep {

std::optional<FileLock> FileLock::try_lock(const std::filesystem::path& path, Kind kind) {
  const bool is_exclusive = kind == Kind::exclusive;
  // NFS makes a lock on bytes of it, which an exclusive one must be allowed to write.
  const int descriptor = ::open(path.c_str(), (is_exclusive ? O_RDWR : O_RDONLY) | O_CLOEXEC);
  if (descriptor < 0) {
    if (errno == ENOENT) return std::nullopt;
    throw std::system_error(errno, std::generic_category(), tumble::format("cannot lock {}", output::path_text(path)));
  }
  FileLock lock(descriptor);
  int failure = 0;
  do {
    failure = ::flock(descriptor, (is_exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0 ? 0 : errno;
  } while (failure == EINTR);
  if (failure == EWOULDBLOCK) return std::nullopt;
  // Between opening and locking, another process may have put a new file in its place, whose lock counts.
  struct stat locked {};
  struct stat named {};
  if (::fstat(descriptor, &locked) != 0 || ::stat(path.c_str(), &named) != 0) return std::nullopt;
  if (locked.st_dev != named.st_dev || locked.st_ino != named.st_ino) return std::nullopt;
  return lock;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace tumble::sweep
