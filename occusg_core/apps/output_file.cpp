// SPDX-License-Identifier: BSD-3-Clause
#include "output_file.hpp"

#include <filesystem>

#include "occusg/error.hpp"

namespace occusg::apps {
namespace {

std::string nameIn(const std::string& path) {
  std::string name = std::filesystem::path(path).filename().string();
  if (name.empty()) throw refuse(path, "is not the name of a file", "a file to write is needed");
  return name;
}

std::string folderOf(const std::string& path) {
  const std::filesystem::path parent = std::filesystem::path(path).parent_path();
  return parent.empty() ? "." : parent.string();
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : name_(nameIn(path)), folder_(folderOf(path)) {}

}  // namespace occusg::apps
