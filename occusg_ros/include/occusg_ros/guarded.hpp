// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/function.hpp>
#include <boost/shared_ptr.hpp>
#include <exception>
#include <new>
#include <string>

namespace occusg_ros {

/// What went wrong, as a sentence: no exception may leave a callback or a worker, since it would
/// end the process with all nodelets in it.
struct Failure {
  std::string problem;
  bool is_out_of_memory = false;
};

/// Runs `work`; what it throws goes to `report`.
/// @param what follows "no more memory for".
template <typename Work, typename Report>
void guarded(const std::string& what, const Work& work, const Report& report) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    report(Failure{"no more memory for " + what, true});
  } catch (const std::exception& error) {
    report(Failure{error.what(), false});
  } catch (...) {
    report(Failure{"something unknown was thrown by " + what, false});
  }
}

/// A callback of `node` for messages of one type that lets nothing through: `Node::onFailure` hears
/// of it.
template <typename Node, typename Message>
boost::function<void(const boost::shared_ptr<const Message>&)> guardedCallback(
    Node* node, void (Node::*callback)(const boost::shared_ptr<const Message>&),
    const std::string& what) {
  return [node, callback, what](const boost::shared_ptr<const Message>& message) {
    guarded(
        what, [&] { (node->*callback)(message); },
        [&](const Failure& failure) { node->onFailure(failure); });
  };
}

}  // namespace occusg_ros
