// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "occusg/io/output_folder.hpp"

namespace occusg::apps {

/// A single file to be written, whole or not at all.
class OutputFile {
 public:
  /// Creates its folder where missing and checks that it can be written.
  /// @throws Error when it cannot.
  explicit OutputFile(const std::string& path);

  void write(const std::string& bytes) const { folder_.write(name_, bytes); }

 private:
  std::string name_;
  OutputFolder folder_;
};

}  // namespace occusg::apps
