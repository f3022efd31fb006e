// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/output_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "io/part_file.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWritable = "a folder that can be written, with space left, is needed";

[[noreturn]] void fail(const std::string& path, int error_number) {
  throw refuse(path, "cannot be written (" + std::generic_category().message(error_number) + ")",
               kWritable);
}

class FileDescriptor {
 public:
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor(FileDescriptor&&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  FileDescriptor& operator=(FileDescriptor&&) = delete;
  ~FileDescriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  [[nodiscard]] int get() const { return descriptor_; }
  /// Closes and tells whether it worked: some file systems report a full disk only here.
  [[nodiscard]] bool close() {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    return ::close(descriptor) == 0;
  }

 private:
  int descriptor_;
};

/// Removes the file at the end of the scope, unless it was renamed by then.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string path) : path_(std::move(path)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile(TemporaryFile&&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  TemporaryFile& operator=(TemporaryFile&&) = delete;
  ~TemporaryFile() { ::unlink(path_.c_str()); }

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

bool writeAll(int descriptor, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return true;
}

void writeDurably(const TemporaryFile& file, const std::string& bytes,
                  const std::string& shown_path) {
  constexpr mode_t kPermissions = 0666;  // less the umask
  ::unlink(file.path().c_str());         // of a process of the same number that was killed
  FileDescriptor descriptor(
      ::open(file.path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kPermissions));
  if (descriptor.get() < 0) fail(shown_path, errno);
  lockPart(descriptor.get());
  if (!writeAll(descriptor.get(), bytes) || ::fsync(descriptor.get()) != 0 || !descriptor.close())
    fail(shown_path, errno);
}

bool isPlainName(const std::string& name) {
  constexpr std::size_t kLongest = 200;
  return !name.empty() && name.size() <= kLongest && name != "." && name != ".." &&
         name.find('/') == std::string::npos && std::none_of(name.begin(), name.end(), isControl);
}

}  // namespace

OutputFolder::OutputFolder(const std::string& path) : path_(path) {
  std::error_code failed;
  if (fs::exists(path_, failed) && !fs::is_directory(path_, failed))
    throw refuse(path_, "is a file", "a folder is needed");
  fs::create_directories(path_, failed);
  if (failed || !fs::is_directory(path_, failed))
    throw refuse(path_, "cannot be created (" + failed.message() + ")", kWritable);
  removeStaleParts(path_);
  writeDurably(TemporaryFile(partPath(path_, "probe")), "probe", path_);
}

void OutputFolder::write(const std::string& name, const std::string& bytes) const {
  if (!isPlainName(name)) {
    throw refuse(path_, "\"" + shown(name) + "\" is not a file name",
                 "a name of at most 200 bytes without a path is needed");
  }
  const std::string target = (fs::path(path_) / name).string();
  const TemporaryFile file(partPath(path_, name));
  writeDurably(file, bytes, target);
  if (std::rename(file.path().c_str(), target.c_str()) != 0) fail(target, errno);
  flush();
}

void OutputFolder::flush() const { flushFolder(path_); }

void flushFolder(const std::string& path) {
  const FileDescriptor descriptor(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // EINVAL: a file system that cannot flush folders.
  if (descriptor.get() < 0 || (::fsync(descriptor.get()) != 0 && errno != EINVAL))
    fail(path, errno);
}

}  // namespace occusg
