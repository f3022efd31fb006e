// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace occusg_ros {

/// Keeps apart what the lives of a system have saved as "last". One life is one run of roslaunch,
/// told by its run id; a node that is respawned belongs to the life it crashed in. Older lives are
/// last.1 to last.3, the newest first.
class SavedGenerations {
 public:
  static constexpr int kKept = 3;

  /// @param folder of all that is saved; need not exist.
  /// @param run_id of roslaunch; empty: this process is a life of its own.
  /// @param node the node's name, for the mark that it is running.
  SavedGenerations(std::string folder, std::string run_id, const std::string& node);
  SavedGenerations(const SavedGenerations&) = delete;
  SavedGenerations& operator=(const SavedGenerations&) = delete;
  SavedGenerations(SavedGenerations&&) = delete;
  SavedGenerations& operator=(SavedGenerations&&) = delete;
  /// The node has ended as it should.
  ~SavedGenerations();

  /// Whether this node has run before in this life and has not ended as it should.
  [[nodiscard]] bool hasCrashed() const { return has_crashed_; }

  /// Makes room for "last" before this life writes it: what another life has saved becomes last.1,
  /// and so on. Does nothing from the second time on.
  /// @throws occusg::Error when the folders cannot be renamed.
  void makeRoom() const;

  /// Renames what could not be loaded, so that nothing overwrites it.
  /// @return its new name, or empty when it is not there (another node of this life was first).
  [[nodiscard]] std::string setAside(const std::string& name) const;

 private:
  std::string folder_;
  std::string run_id_;
  std::string running_mark_;
  bool has_crashed_ = false;
};

}  // namespace occusg_ros
