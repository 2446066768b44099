#include "apps/frontend/run/option_words.h"

#include <doctest/doctest.h>

namespace dmpc::tests::option_words_test {

TEST_CASE("what a plan says of its fields is said of the options that set them") {
  constexpr core::Field node_count = core::field_of<&nodes::ComputerRequest::node_count>(),
                        memory = core::field_of<&nodes::ComputerRequest::node_memory_bytes>(),
                        reserve = core::field_of<&nodes::ComputerRequest::stack_reserve_bytes>();
  const auto in_options = [](const core::Sentence& sentence) { return apps::in_options(sentence, apps::computer_words); };
  const core::Sentence range(node_count, "=", 5000, ": from 1 to 4096 nodes");
  CHECK(range.text() == "node_count=5000: from 1 to 4096 nodes");
  CHECK(in_options(range) == "--nodes=5000: from 1 to 4096 nodes");
  CHECK(in_options(core::Sentence(memory, "=1KiB is too small for ", node_count, "=8")) ==
        "--node-memory=1KiB is too small for --nodes=8");
  CHECK(in_options(core::Sentence("nothing of that")) == "nothing of that");
  CHECK(in_options(core::Sentence(node_count, "=3, or host_node_count=3")) == "--nodes=3, or host_node_count=3");
  CHECK(in_options(core::Sentence(reserve, "=0, which no option sets")) == "stack_reserve_bytes=0, which no option sets");
}

}  // namespace dmpc::tests::option_words_test
