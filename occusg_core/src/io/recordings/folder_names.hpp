// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/recordings/recording.hpp"

namespace occusg {

/// Images of a recording without time stamps are this many a second, as its makers say.
inline constexpr double kNumberedImagesPerSecond = 30.0;

[[nodiscard]] std::string joined(const std::string& folder, const std::string& name);
[[nodiscard]] bool existsIn(const std::string& folder, const std::string& name);
[[nodiscard]] bool isFolderIn(const std::string& folder, const std::string& name);

/// Names of what lies in a folder, sorted; empty when it cannot be read.
/// @throws Error when there are more than a million.
[[nodiscard]] std::vector<std::string> namesIn(const std::string& folder);

/// The number in "<prefix>NUMBER<suffix>"; empty when the name has another form.
[[nodiscard]] std::optional<long> numberInName(const std::string& name, const std::string& prefix,
                                               const std::string& suffix);

/// A file of a numbered series.
struct NumberedFile {
  long number = 0;
  std::string path;  ///< Relative to the recording's folder.
};

/// The files "<prefix>NUMBER<suffix>" of a folder within the recording ("" for the recording
/// itself), by number.
[[nodiscard]] std::vector<NumberedFile> numberedFiles(const std::string& recording,
                                                      const std::string& folder,
                                                      const std::string& prefix,
                                                      const std::string& suffix);

/// The files as images, `kNumberedImagesPerSecond`.
[[nodiscard]] std::vector<RecordedImage> imagesOf(const std::vector<NumberedFile>& files);

/// Size of the first image that can be read.
/// @throws Error when none can.
struct ImageSize {
  int width = 0;
  int height = 0;
};
[[nodiscard]] ImageSize sizeOfFirst(const std::string& recording,
                                    const std::vector<RecordedImage>& images);

}  // namespace occusg
