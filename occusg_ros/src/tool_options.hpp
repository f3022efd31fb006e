// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>
#include <optional>
#include <string>

namespace occusg_ros {

/// Parses the command line of a tool that takes one thing without a name and options by name.
/// @param named the options --help prints, with what stands above them.
/// @param unnamed receives the thing without a name.
/// @return nothing when help was asked for, and printed.
/// @throws boost::program_options::error naming the option that is wrong.
[[nodiscard]] std::optional<boost::program_options::variables_map> parseToolOptions(
    int argc, char** argv, boost::program_options::options_description named, std::string& unnamed);

}  // namespace occusg_ros
