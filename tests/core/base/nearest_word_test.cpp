#include "core/base/nearest_word.h"

#include <doctest/doctest.h>

#include <vector>

namespace dmpc::core::nearest_word_test {

namespace {

const std::vector<std::string> known = {"--nodes", "--node-memory", "--resolution", "--record-order", "svm"};

}  // namespace

TEST_CASE("words lie as many letters apart as must be changed") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("nodes", "nods") == 1);
  CHECK(edit_distance("nodes", "ndoes") == 1);
  CHECK(edit_distance("nodes", "modes") == 1);
  CHECK(edit_distance("SVM", "svm") == 0);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("the nearest word is found if it is near") {
  CHECK(nearest_word("--nods", known) == "--nodes");
  CHECK(nearest_word("--resolutoin", known) == "--resolution");
  CHECK(nearest_word("SVN", known) == "svm");
  CHECK_FALSE(nearest_word("--light", known));
  CHECK_FALSE(nearest_word("", known));
  CHECK_FALSE(nearest_word("x", known));
  CHECK_FALSE(nearest_word(std::string(10'000, 'n'), known));
  CHECK_FALSE(nearest_word("svm", {}));
}

TEST_CASE("a beginning is completed if no other word begins so") {
  CHECK(nearest_word("--res", known) == "--resolution");
  CHECK_FALSE(nearest_word("--r", known));
  CHECK_FALSE(nearest_word("--re", known));
}

TEST_CASE("a question follows a sentence, or nothing does") {
  CHECK(did_you_mean("--nods", known) == " Did you mean --nodes?");
  CHECK(did_you_mean("--light", known).empty());
}

}  // namespace dmpc::core::nearest_word_test
