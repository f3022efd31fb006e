// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace occusg {

/// Size and content of a file, to tell a damaged one or one of another run.
struct FileMark {
  std::size_t bytes = 0;
  std::uint64_t checksum = 14'695'981'039'346'656'037U;  ///< FNV-1a, 64 bit (Fowler, Noll, Vo).

  /// Takes in the bytes that follow.
  void add(std::string_view more);
  [[nodiscard]] bool operator==(const FileMark& other) const {
    return bytes == other.bytes && checksum == other.checksum;
  }
};

/// A folder results are written to. A file appears whole or not at all: it is written under a
/// temporary name beside its place, flushed to the disk and renamed, so that neither a crash nor a
/// full disk leaves half a file or loses the previous one. Temporary files of runs that were killed
/// are removed when the folder is opened.
class OutputFolder {
 public:
  /// Creates the folder and its parents where missing, and writes a file for a try, so that a long
  /// run does not find out at its end.
  /// @throws Error when it is a file or cannot be created or written.
  explicit OutputFolder(const std::string& path);

  /// Writes `bytes` to the file `name`, replacing it.
  /// @param name a plain file name.
  /// @throws Error naming the file and the reason (read-only, no space left, ...); a previous file
  /// of that name is untouched.
  void write(const std::string& name, const std::string& bytes) const;

  /// The same with what `writer` puts into the stream, which is never wholly in memory.
  /// @return size and checksum of the file.
  /// @throws Error also when the file would be larger than `max_bytes`, and whatever `writer`
  /// throws.
  FileMark write(const std::string& name, const std::function<void(std::ostream&)>& writer,
                 std::size_t max_bytes = kMaxFileBytes) const;
  static constexpr std::size_t kMaxFileBytes = std::size_t{1} << 40U;

  /// Makes a rename in the folder last through a power cut.
  /// @throws Error when that fails.
  void flush() const;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Makes a rename in a folder last through a power cut.
/// @throws Error naming the folder when that fails.
void flushFolder(const std::string& path);

}  // namespace occusg
