// SPDX-License-Identifier: BSD-3-Clause
#include "io/recordings/folder_names.hpp"

#include <algorithm>
#include <filesystem>

#include "io/file_bytes.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"
#include "occusg/io/png_check.hpp"

namespace occusg {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxDepthImageBytes = std::size_t{1} << 30U;
constexpr std::size_t kMostDigits = 9;

}  // namespace

std::string joined(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

bool existsIn(const std::string& folder, const std::string& name) {
  std::error_code failed;
  return fs::exists(joined(folder, name), failed);
}

bool isFolderIn(const std::string& folder, const std::string& name) {
  std::error_code failed;
  return fs::is_directory(joined(folder, name), failed);
}

std::vector<std::string> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  for (fs::directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed)) {
    if (names.size() == kMaxLines) {
      throw refuse(folder, "holds more than " + std::to_string(kMaxLines) + " files",
                   "a shorter recording is needed");
    }
    names.push_back(it->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<long> numberInName(const std::string& name, const std::string& prefix,
                                 const std::string& suffix) {
  if (name.size() <= prefix.size() + suffix.size()) return std::nullopt;
  if (name.compare(0, prefix.size(), prefix) != 0) return std::nullopt;
  const std::size_t end = name.size() - suffix.size();
  if (name.compare(end, suffix.size(), suffix) != 0) return std::nullopt;
  const std::string digits = name.substr(prefix.size(), end - prefix.size());
  if (digits.size() > kMostDigits || digits.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  return std::stol(digits);
}

std::vector<NumberedFile> numberedFiles(const std::string& recording, const std::string& folder,
                                        const std::string& prefix, const std::string& suffix) {
  std::vector<NumberedFile> files;
  for (const std::string& name : namesIn(joined(recording, folder))) {
    if (const auto number = numberInName(name, prefix, suffix))
      files.push_back({*number, (fs::path(folder) / name).string()});
  }
  std::stable_sort(files.begin(), files.end(), [](const NumberedFile& a, const NumberedFile& b) {
    return a.number < b.number;
  });
  return files;
}

std::vector<RecordedImage> imagesOf(const std::vector<NumberedFile>& files) {
  std::vector<RecordedImage> images;
  images.reserve(files.size());
  for (const NumberedFile& file : files) {
    images.push_back(
        {static_cast<double>(file.number) / kNumberedImagesPerSecond, file.path, std::string()});
  }
  return images;
}

ImageSize sizeOfFirst(const std::string& recording, const std::vector<RecordedImage>& images) {
  std::string first_problem = refuse(recording, "lists no depth image", "one is needed").what();
  for (const RecordedImage& image : images) {
    if (!image.problem.empty()) continue;
    const std::string path = joined(recording, image.path);
    try {
      const PngHeader header = checkPng(readFile(path, kMaxDepthImageBytes), path);
      return {header.width, header.height};
    } catch (const Error& error) {
      first_problem = error.what();
    }
  }
  throw Error(first_problem);
}

}  // namespace occusg
