// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>
#include <optional>
#include <string>
#include <vector>

namespace occusg_ros {

/// Parses the command line of a tool that takes things without a name and options by name.
/// @param named the options --help prints, with what stands above them.
/// @param unnamed receives the things without a name.
/// @return nothing when help was asked for, and printed.
/// @throws boost::program_options::error naming the option that is wrong.
[[nodiscard]] std::optional<boost::program_options::variables_map> parseToolOptions(
    int argc, char** argv, boost::program_options::options_description named,
    std::vector<std::string>& unnamed);

}  // namespace occusg_ros
