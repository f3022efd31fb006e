// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/output_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <ostream>
#include <streambuf>
#include <system_error>
#include <utility>
#include <vector>

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

bool writeAll(int descriptor, const char* bytes, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t written = ::write(descriptor, bytes + done, size - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return true;
}

/// Writes to a descriptor, and marks what it wrote. Fails for good when a write does.
class FileBuffer final : public std::streambuf {
 public:
  FileBuffer(int descriptor, std::size_t max_bytes)
      : descriptor_(descriptor), max_bytes_(max_bytes), buffer_(kBufferBytes) {
    setp(buffer_.data(), buffer_.data() + buffer_.size());
  }

  [[nodiscard]] const FileMark& mark() const { return mark_; }
  [[nodiscard]] bool isTooLarge() const { return mark_.bytes > max_bytes_; }
  /// Of the write that failed.
  [[nodiscard]] int errorNumber() const { return error_number_; }

 protected:
  int_type overflow(int_type next) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(next, traits_type::eof())) {
      *pptr() = traits_type::to_char_type(next);
      pbump(1);
    }
    return traits_type::not_eof(next);
  }

  int sync() override {
    const auto size = static_cast<std::size_t>(pptr() - pbase());
    mark_.add({pbase(), size});
    if (isTooLarge() || error_number_ != 0) return -1;
    if (!writeAll(descriptor_, pbase(), size)) {
      error_number_ = errno;
      return -1;
    }
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return 0;
  }

 private:
  static constexpr std::size_t kBufferBytes = std::size_t{1} << 16U;

  int descriptor_;
  std::size_t max_bytes_;
  std::vector<char> buffer_;
  FileMark mark_;
  int error_number_ = 0;
};

using Writer = std::function<void(std::ostream&)>;

FileMark writeDurably(const TemporaryFile& file, const Writer& writer,
                      const std::string& shown_path, std::size_t max_bytes) {
  constexpr mode_t kPermissions = 0666;  // less the umask
  ::unlink(file.path().c_str());         // of a process of the same number that was killed
  FileDescriptor descriptor(
      ::open(file.path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kPermissions));
  if (descriptor.get() < 0) fail(shown_path, errno);
  lockPart(descriptor.get());
  FileBuffer buffer(descriptor.get(), max_bytes);
  std::ostream out(&buffer);
  writer(out);
  out.flush();
  if (buffer.isTooLarge()) {
    throw refuse(shown_path, "would be larger than " + std::to_string(max_bytes) + " bytes",
                 "no larger file can be read back");
  }
  if (!out) fail(shown_path, buffer.errorNumber());
  if (::fsync(descriptor.get()) != 0 || !descriptor.close()) fail(shown_path, errno);
  return buffer.mark();
}

Writer writerOf(const std::string& bytes) {
  return [&bytes](std::ostream& out) {
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  };
}

bool isPlainName(const std::string& name) {
  constexpr std::size_t kLongest = 200;
  return !name.empty() && name.size() <= kLongest && name != "." && name != ".." &&
         name.find('/') == std::string::npos && std::none_of(name.begin(), name.end(), isControl);
}

/// Where the bytes go: a link stays, and the file it leads to is replaced.
fs::path targetOf(const fs::path& path) {
  std::error_code failed;
  fs::path target = fs::is_symlink(path, failed) ? fs::canonical(path, failed) : path;
  if (failed) target = path;  // a link that leads nowhere
  const fs::file_status status = fs::status(target, failed);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw refuse(path.string(), fs::is_directory(status) ? "is a folder" : "is a device or a pipe",
                 "a new name or that of a regular file is needed");
  }
  return target;
}

}  // namespace

OutputFolder::OutputFolder(const std::string& path) : path_(path) {
  std::error_code failed;
  if (fs::exists(path_, failed) && !fs::is_directory(path_, failed))
    throw refuse(path_, "is a file", "a folder is needed");
  // A link to a folder is one already; older standard libraries refuse to create it.
  if (!fs::is_directory(path_, failed)) fs::create_directories(path_, failed);
  if (failed || !fs::is_directory(path_, failed))
    throw refuse(path_, "cannot be created (" + failed.message() + ")", kWritable);
  removeStaleParts(path_);
  const std::string probe = "probe";
  writeDurably(TemporaryFile(partPath(path_, probe)), writerOf(probe), path_, kMaxFileBytes);
}

void OutputFolder::write(const std::string& name, const std::string& bytes) const {
  (void)write(name, writerOf(bytes));
}

FileMark OutputFolder::write(const std::string& name, const Writer& writer,
                             std::size_t max_bytes) const {
  if (!isPlainName(name)) {
    throw refuse(path_, "\"" + shown(name) + "\" is not a file name",
                 "a name of at most 200 bytes without a path is needed");
  }
  const fs::path named = fs::path(path_) / name;
  const fs::path place = targetOf(named);
  if (place != named) {
    const OutputFolder other(place.parent_path().string());
    return other.write(place.filename().string(), writer, max_bytes);
  }
  const std::string target = place.string();
  const TemporaryFile file(partPath(path_, name));
  const FileMark mark = writeDurably(file, writer, target, max_bytes);
  if (std::rename(file.path().c_str(), target.c_str()) != 0) fail(target, errno);
  flush();
  return mark;
}

void OutputFolder::flush() const { flushFolder(path_); }

void flushFolder(const std::string& path) {
  const FileDescriptor descriptor(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // EINVAL: a file system that cannot flush folders.
  if (descriptor.get() < 0 || (::fsync(descriptor.get()) != 0 && errno != EINVAL))
    fail(path, errno);
}

}  // namespace occusg
