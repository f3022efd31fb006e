// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "occusg/error.hpp"

namespace occusg::testing {

/// The sentence of the `Error` that `action` throws; a failure and "" when it throws none.
template <typename Action>
std::string sentenceOf(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no occusg::Error was thrown";
  return "";
}

/// Whether all `parts` are in `sentence`, and it is one line.
inline ::testing::AssertionResult tells(const std::string& sentence,
                                        const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    if (sentence.find(part) == std::string::npos)
      return ::testing::AssertionFailure() << "\"" << part << "\" is not in: " << sentence;
  if (sentence.find('\n') != std::string::npos)
    return ::testing::AssertionFailure() << "more than one line: " << sentence;
  return ::testing::AssertionSuccess();
}

}  // namespace occusg::testing
