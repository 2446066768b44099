#include "apps/frontend/ranks/compatibility.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/render/self_test.h"
#include "core/base/expect.h"
#include "tests/support/complaint.h"

namespace dmpc::tests::compatibility_test {

namespace {

using apps::Compatibility;

const std::vector<std::string> names = {"rank 0 on host a", "rank 1 on host b", "rank 2 on host c"};

/// What ranks with these have against each other; empty if nothing.
std::string complaint_of(const std::vector<Compatibility>& likenesses) {
  std::vector<std::string> texts;
  for (const Compatibility& compatibility : likenesses) {
    texts.push_back(apps::text_of(compatibility));
  }
  return tests::complaint_of([&] { apps::expect_alike(texts, names); });
}

const Compatibility usual = {{"version of dmpc", "0.1.0"}, {"byte order", "little"}};

}  // namespace

TEST_CASE("ranks that are alike, or one alone, are let pass") {
  CHECK(complaint_of({usual}) == "");
  CHECK(complaint_of({usual, usual, usual}) == "");
  const Compatibility own = apps::renderer_compatibility();
  CHECK(own.size() == 6);
  CHECK(complaint_of({own, apps::renderer_compatibility()}) == "");
}

TEST_CASE("the first that differs is named with its host, what it has, and what rank 0 has") {
  CHECK(complaint_of({usual, usual, {{"version of dmpc", "0.1.0"}, {"byte order", "big"}}}) ==
        "the ranks are not compatible, so they cannot compute one result: rank 2 on host c has byte order big, rank 0 on host a "
        "has byte order little: start the same on all of them");
  CHECK(complaint_of({usual, {{"version of dmpc", "0.2.0"}, {"byte order", "big"}}, usual})
            .find("rank 1 on host b has version of dmpc 0.2.0, rank 0 on host a has version of dmpc 0.1.0:") !=
        std::string::npos);
}

TEST_CASE("a rank that has less to say differs") {
  CHECK(complaint_of({usual, {usual.front()}}).find("rank 1 on host b has nothing, rank 0 on host a has byte order little") !=
        std::string::npos);
  CHECK(complaint_of({{}, usual}).find("rank 1 on host b has version of dmpc 0.1.0, rank 0 on host a has nothing") !=
        std::string::npos);
}

}  // namespace dmpc::tests::compatibility_test
