// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_mark.hpp"

namespace occusg {

void FileMark::add(std::string_view more) {
  constexpr std::uint64_t kPrime = 1'099'511'628'211U;
  bytes += more.size();
  for (const char byte : more) checksum = (checksum ^ static_cast<unsigned char>(byte)) * kPrime;
}

FileMark markOf(std::string_view bytes) {
  FileMark mark;
  mark.add(bytes);
  return mark;
}

bool parseChecksum(const std::string& text, std::uint64_t& checksum) {
  constexpr std::size_t kMaxDigits = 20;
  if (text.empty() || text.size() > kMaxDigits ||
      text.find_first_not_of("0123456789") != std::string::npos)
    return false;
  checksum = 0;
  for (const char digit : text) checksum = 10 * checksum + static_cast<unsigned>(digit - '0');
  return true;
}

}  // namespace occusg
