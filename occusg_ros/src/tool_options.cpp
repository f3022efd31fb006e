// SPDX-License-Identifier: BSD-3-Clause
#include "tool_options.hpp"

#include <iostream>

namespace occusg_ros {

namespace po = boost::program_options;

std::optional<po::variables_map> parseToolOptions(int argc, char** argv,
                                                  po::options_description named,
                                                  std::vector<std::string>& unnamed) {
  named.add_options()("help,h", "print this");
  po::options_description all;
  all.add(named).add_options()("unnamed", po::value(&unnamed));
  po::positional_options_description positional;
  positional.add("unnamed", -1);
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(all).positional(positional).run(), values);
  po::notify(values);
  if (values.count("help") == 0) return values;
  std::cout << named << '\n';
  return std::nullopt;
}

}  // namespace occusg_ros
