// A program on the computer as if its words were typed.
#pragma once

#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace dmpc::tests {

struct Ran {
  int status = 0;
  std::string output, errors;

  bool complains(const std::string& part) const { return errors.find(part) != std::string::npos; }
};

/// Calls main(count, words) with `name` and the words behind it.
template <class Main>
Ran ran(const std::string& name, const std::vector<std::string>& words, const Main& main) {
  std::vector<const char*> all = {name.c_str()};
  for (const std::string& word : words) {
    all.push_back(word.c_str());
  }
  std::ostringstream output, errors;
  std::streambuf* const out = std::cout.rdbuf(output.rdbuf());
  std::streambuf* const err = std::cerr.rdbuf(errors.rdbuf());
  const int status = main(static_cast<int>(all.size()), all.data());
  std::cout.rdbuf(out);
  std::cerr.rdbuf(err);
  return {status, output.str(), errors.str()};
}

}  // namespace dmpc::tests
