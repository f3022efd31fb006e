// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_bytes.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "occusg/error.hpp"

namespace occusg {
namespace {

std::string reason(int error_number) {
  return error_number == 0 ? "no reason given" : std::generic_category().message(error_number);
}

/// Size of the regular file at `path`; anything else (a pipe would block the reader) is refused.
std::uintmax_t regularFileSize(const std::string& path) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (!std::filesystem::exists(status))
    throw refuse(path, "does not exist", "a readable file is needed");
  if (!std::filesystem::is_regular_file(status))
    throw refuse(path, "is not a regular file", "a readable file is needed");
  const std::uintmax_t size = std::filesystem::file_size(path, failed);
  if (failed)
    throw refuse(path, "cannot be read (" + failed.message() + ")", "a readable file is needed");
  return size;
}

std::string readBytes(const std::string& path, std::size_t count) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw refuse(path, "cannot be opened (" + reason(errno) + ")", "a readable file is needed");
  std::string bytes(count, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  if (file.bad())
    throw refuse(path, "cannot be read (" + reason(errno) + ")", "a readable file is needed");
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

}  // namespace

std::string readFile(const std::string& path, std::size_t max_bytes) {
  const std::uintmax_t size = regularFileSize(path);
  if (size > max_bytes) {
    throw refuse(path, "is " + std::to_string(size) + " bytes long",
                 "at most " + std::to_string(max_bytes) + " bytes are read");
  }
  return readBytes(path, static_cast<std::size_t>(size));
}

std::string readBeginning(const std::string& path, std::size_t count) {
  const std::uintmax_t size = regularFileSize(path);
  return readBytes(path, static_cast<std::size_t>(std::min<std::uintmax_t>(size, count)));
}

}  // namespace occusg
