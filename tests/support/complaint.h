// What is said of what is refused.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::tests {

/// The message of the Error with which `act` ends; empty if it ends well. Other exceptions pass.
template <class Error = core::InputError, class Act>
std::string complaint_of(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// What somebody is given, and words of what is said of it: none if nothing is.
struct Complaint {
  std::string given, words;
};

/// Holds each against complaint(given).
template <class Complain>
void check_complaints(const Complain& complaint, const std::vector<Complaint>& all) {
  for (const auto& [given, words] : all) {
    const std::string said = complaint(given);
    CHECK_MESSAGE((words.empty() ? said.empty() : said.find(words) != std::string::npos),
                  words << " / " << given << " / " << said);
  }
}

}  // namespace dmpc::tests
