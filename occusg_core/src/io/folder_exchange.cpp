// SPDX-License-Identifier: BSD-3-Clause
#include "io/folder_exchange.hpp"

#include <fcntl.h>
#include <stdio.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "occusg/error.hpp"
#include "occusg/io/output_folder.hpp"

namespace occusg {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failToReplace(const fs::path& place, int error_number) {
  throw refuse(place.string(),
               "cannot be replaced (" + std::generic_category().message(error_number) + ")",
               "save the session under a new name");
}

std::string around(const fs::path& place) {
  return place.has_parent_path() ? place.parent_path().string() : std::string(".");
}

void renameInSteps(const fs::path& fresh, const fs::path& place) {
  const fs::path aside = placeOfTheSetAside(place);
  std::error_code ignored;
  fs::remove_all(aside, ignored);  // `place` stands, so this one has been replaced
  if (::rename(place.c_str(), aside.c_str()) != 0) failToReplace(place, errno);
  flushFolder(around(place));
  if (::rename(fresh.c_str(), place.c_str()) != 0) {
    const int reason = errno;
    (void)::rename(aside.c_str(), place.c_str());
    failToReplace(place, reason);
  }
}

}  // namespace

fs::path placeOfTheSetAside(const fs::path& place) {
  return place.parent_path() / ("." + place.filename().string() + ".before");
}

void putInPlace(const fs::path& fresh, const fs::path& place) {
  if (::rename(fresh.c_str(), place.c_str()) != 0 &&
      ::renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, place.c_str(), RENAME_EXCHANGE) != 0)
    renameInSteps(fresh, place);
  flushFolder(around(place));
  std::error_code ignored;
  fs::remove_all(placeOfTheSetAside(place), ignored);
}

fs::path standingFolder(const fs::path& place) {
  std::error_code failed;
  const fs::path aside = placeOfTheSetAside(place);
  return !fs::exists(place, failed) && fs::is_directory(aside, failed) ? aside : place;
}

}  // namespace occusg
