// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <string>

namespace occusg_ros {

/// What became of the savings of a node.
class SaveStatus {
 public:
  /// @param now_s the steady clock.
  explicit SaveStatus(double now_s = 0.0) : saved_s_(now_s) {}

  /// @param problem the sentence of what went wrong; empty: the folder was written.
  void note(const std::string& folder, const std::string& problem, double now_s);
  /// Adds "last save", and raises the level while savings fail: to a warning, and to an error when
  /// the last one that went well is more than a minute old.
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status, double now_s) const;

 private:
  std::string last_ = "never";
  std::string problem_;
  double saved_s_;
};

}  // namespace occusg_ros
