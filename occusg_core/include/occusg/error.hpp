// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace occusg {

/// The one exception family of the core: something outside (a file, a message, a parameter) cannot
/// be used. `what()` is one sentence a user can act on: where, what is wrong, what would be right.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Composes "<where>: <wrong>; <right>", the sentence every `Error` carries.
/// @param where file (and line), parameter key or topic the value came from.
/// @param wrong what was found, with the value.
/// @param right what would be accepted.
[[nodiscard]] inline Error refuse(const std::string& where, const std::string& wrong,
                                  const std::string& right) {
  return Error(where + ": " + wrong + "; " + right);
}

}  // namespace occusg
