#include "core/database/brick_tree.h"

#include <doctest/doctest.h>

#include "core/record/records.h"

namespace brick_tree_test {

using namespace dmpc::core;

TEST_CASE("a brick comes before its blocks, and these before its bricks, each where its parent says") {
  BrickDraft below{.brick = {.child_count = 1}};
  below.blocks[0] = {.first = 1, .count = 2, .kind = PrimitiveKind::sphere};
  BrickTree tree{.top = {.brick = {.child_count = 2}}, .ids = {2, 0, 1}};
  tree.top.blocks[1] = {.first = 0, .count = 1, .kind = PrimitiveKind::sphere};
  tree.top.bricks.push_back(below);
  std::vector<PrimitiveValues> primitives(3, {.kind = PrimitiveKind::sphere});
  for (std::size_t id = 0; id < primitives.size(); ++id) {
    primitives[id].value[0] = static_cast<float>(id);
  }
  const std::vector<ShadingReference> shading(3, ShadingReference::flat(7));
  RecordWriter writer(512);
  const Address top = tree.take_room(writer);
  writer.make_room();
  tree.write(primitives, shading, {}, writer);
  const std::vector<std::byte> bytes = std::move(writer).finish();
  const LocalRecords records(bytes);
  const auto first = read<Brick>(records.find(top));
  CHECK(first.child[1].is_block());
  REQUIRE_FALSE(first.child[0].is_block());
  CHECK(byte_offset(top) < byte_offset(first.child[1].address()));
  CHECK(byte_offset(first.child[1].address()) < byte_offset(first.child[0].address()));
  const auto second = read<Brick>(records.find(first.child[0].address()));
  const std::byte* const block = records.find(second.child[0].address());
  CHECK(read<BlockHeader>(block).count == 2);
  CHECK(read<float>(block + sizeof(BlockHeader) + 4) == 1.0F);
  CHECK(read<std::uint32_t>(block + sizeof(BlockHeader) + 4 * 10) == 0);
  CHECK(read<ShadingReference>(block + sizeof(BlockHeader) + 4 * 12).material() == 7);
}

}  // namespace brick_tree_test
