// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <ostream>
#include <streambuf>
#include <string>
#include <vector>

namespace occusg_ros {

/// Takes what a stream writes in pieces of one size, so that it never moves and takes no more
/// memory than it is long. A `std::stringbuf` doubles as it grows, and is copied to be read.
class ChunkedBuffer : public std::streambuf {
 public:
  void writeTo(std::ostream& out) const {
    for (const std::string& chunk : chunks_)
      out.write(chunk.data(), static_cast<std::streamsize>(chunk.size()));
  }
  [[nodiscard]] std::size_t size() const {
    return chunks_.empty() ? 0 : (chunks_.size() - 1) * kChunkBytes + chunks_.back().size();
  }

 protected:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    for (std::streamsize done = 0; done < count;) {
      if (chunks_.empty() || chunks_.back().size() == kChunkBytes) {
        chunks_.emplace_back();
        chunks_.back().reserve(kChunkBytes);
      }
      std::string& chunk = chunks_.back();
      const auto fits =
          std::min(static_cast<std::streamsize>(kChunkBytes - chunk.size()), count - done);
      chunk.append(bytes + done, static_cast<std::size_t>(fits));
      done += fits;
    }
    return count;
  }
  int_type overflow(int_type byte) override {
    if (traits_type::eq_int_type(byte, traits_type::eof())) return traits_type::not_eof(byte);
    const char c = traits_type::to_char_type(byte);
    (void)xsputn(&c, 1);
    return byte;
  }

 private:
  static constexpr std::size_t kChunkBytes = std::size_t{1} << 18U;
  std::vector<std::string> chunks_;
};

}  // namespace occusg_ros
