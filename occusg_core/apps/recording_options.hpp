// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>
#include <optional>
#include <string>
#include <vector>

#include "occusg/geometry/pose.hpp"
#include "occusg/io/sequence_reader.hpp"

namespace occusg::apps {

/// Adds --poses, --camera, --depth-scale, --pose-frame, --quaternion and --level.
void addRecordingOptions(boost::program_options::options_description& options);

/// How the options say that the recording is to be read.
/// @throws UsageError for a value that is none.
[[nodiscard]] SequenceReaderConfig readingFrom(const boost::program_options::variables_map& values);

/// How the recording's map is taken, and what is doubtful about it.
struct Placement {
  Pose T_level_map = Pose::Identity();  ///< Applied to every pose; of --level.
  /// One sentence each: what was assumed, or looks wrong, and which option mends it.
  std::vector<std::string> doubts;
  std::optional<std::string> levelled;  ///< What --level did.
};

/// Looks at a sample of the frames.
[[nodiscard]] Placement placementOf(const SequenceReader& sequence, const std::string& folder,
                                    const SequenceReaderConfig& reading, bool level);

}  // namespace occusg::apps
