// SPDX-License-Identifier: BSD-3-Clause
#include "output_place.hpp"

#include <filesystem>
#include <system_error>

#include "occusg/error.hpp"
#include "occusg/io/output_folder.hpp"
#include "occusg/io/session_folder.hpp"

namespace occusg::apps {
namespace {

namespace fs = std::filesystem;

fs::path withoutSlash(const fs::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

/// The whole path without links and dots, as far as it exists.
fs::path plainPath(const std::string& path) {
  std::error_code failed;
  const fs::path whole = fs::absolute(path, failed).lexically_normal();
  const fs::path plain = fs::weakly_canonical(whole, failed);
  return withoutSlash(failed ? whole : plain);
}

bool isWithin(const fs::path& path, const fs::path& folder) {
  const fs::path relative = path.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

void checkNotAnInput(const std::string& written, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code failed;
    if (fs::equivalent(written, input, failed) && !failed)
      throw refuse(written, "is read and would be written over", "another name is needed");
  }
}

void checkNotInputs(const std::string& folder, const std::vector<std::string>& names,
                    const std::vector<std::string>& inputs) {
  for (const std::string& name : names) {
    const std::string written = (fs::path(folder) / name).string();
    for (const std::string& input : inputs) {
      std::error_code failed;
      if (fs::equivalent(written, input, failed) && !failed) {
        throw refuse(input, "is read, and the " + name + " of the results would replace it",
                     "another folder is needed for the results");
      }
    }
  }
}

void checkSessionCanBeSaved(const std::string& session, const std::string& output) {
  checkSessionPlace(session);
  if (isWithin(plainPath(output), plainPath(session))) {
    throw refuse("--save-session " + session,
                 "would replace the results in " + output + " with the session",
                 "a folder of its own is needed for the session");
  }
  // A session is written beside its place first.
  std::error_code failed;
  const fs::path place = withoutSlash(fs::absolute(session, failed).lexically_normal());
  const OutputFolder beside(place.parent_path().string());
}

}  // namespace occusg::apps
