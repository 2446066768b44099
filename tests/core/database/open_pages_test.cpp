// Where the records of base meshes and their places lie: in the forest, in open pages, and in pages that hold all that is below.
#include <doctest/doctest.h>

#include <cstdint>
#include <set>

#include "core/database/database.h"
#include "core/record/instance.h"
#include "core/record/record_kind.h"
#include "core/record/records.h"
#include "tests/support/base_mesh_scenes.h"

namespace dmpc::tests::open_pages_test {
namespace {

using core::Address;
using core::BvhChild;

/// What is found below the directory.
struct Found {
  std::set<Address> instances, meshes;
  std::uint32_t open_bvh_nodes = 0, open_leaves = 0, closed_pages = 0;
};

class Walker {
 public:
  explicit Walker(const core::Database& database) : database_(database), records_(database.bytes()) {}

  Found all() {
    const auto entry = core::read<core::DirectoryEntry>(records_.find(database_.header().directory));
    visit(BvhChild::bvh_node(entry.bvh_node()));
    return found_;
  }

 private:
  bool is_in_forest(Address address) const { return page_of(address) < database_.forest_page_count(); }
  bool is_open(Address address) const {
    return !is_in_forest(address) && page_of(address) < database_.forest_page_count() + database_.open_page_count();
  }
  std::size_t page_of(Address address) const { return core::byte_offset(address) / database_.page_size(); }

  void visit(BvhChild child) {
    const Address address = child.address();
    if (!is_in_forest(address) && !is_open(address)) {
      ++found_.closed_pages;
      stay(child, page_of(address));
    } else if (child.is_leaf()) {
      visit_leaf(address);
    } else {
      found_.open_bvh_nodes += is_open(address) ? 1 : 0;
      const auto bvh_node = core::read<core::BvhNode>(records_.find(address));
      for (std::size_t i = 0; i < bvh_node.child_count; ++i) {
        visit(bvh_node.child[i]);
        const bool is_open_bvh_node = is_open(address) && is_open(bvh_node.child[i].address());
        CHECK((!is_open_bvh_node || page_of(bvh_node.child[i].address()) == page_of(address)));
      }
    }
  }

  void visit_leaf(Address address) {
    const std::byte* const leaf = records_.find(address);
    const auto header = core::read<core::LeafHeader>(leaf);
    if (header.kind != core::PrimitiveKind::instance) {
      CHECK(is_in_forest(address));
      return;
    }
    found_.open_leaves += is_open(address) ? 1 : 0;
    for (std::uint32_t lane = 0; lane < header.count; ++lane) {
      const Address instance = core::instance_in(leaf, lane);
      CHECK(is_open(instance));
      CHECK(found_.instances.insert(instance).second);
      const std::byte* const record = records_.find(instance);
      CHECK(core::bytes_of(core::RecordKind::leaf, record) == sizeof(core::InstanceRecord));
      const Address root = core::read<core::InstanceRecord>(record).root;
      if (found_.meshes.insert(root).second) {
        visit(BvhChild::bvh_node(root));
      }
    }
  }

  /// All that is below lies in this page, and leads nowhere else.
  void stay(BvhChild child, std::size_t page) {
    CHECK(page_of(child.address()) == page);
    if (child.is_leaf()) {
      CHECK(core::read<core::LeafHeader>(records_.find(child.address())).kind != core::PrimitiveKind::instance);
      return;
    }
    const auto bvh_node = core::read<core::BvhNode>(records_.find(child.address()));
    for (std::size_t i = 0; i < bvh_node.child_count; ++i) {
      stay(bvh_node.child[i], page);
    }
  }

  const core::Database& database_;
  core::LocalRecords records_;
  Found found_;
};

}  // namespace

TEST_CASE("what leads into meshes is in the forest or in open pages, and all other pages hold all that is below them") {
  for (const std::size_t page_size : {512U, 1024U, 4096U, 65536U}) {
    for (const core::Scene& scene : {field_of_balls(8), balls_in_places(0.3, Arrangement::deep_in_each_other, 21)}) {
      CAPTURE(page_size);
      const core::Database database = core::build_database(scene, with_instances(page_size));
      REQUIRE(database.records().instances > 0);
      const Found found = Walker(database).all();
      CHECK(found.instances.size() == database.records().instances);
      CHECK(found.meshes.size() == database.records().base_meshes);
      CHECK(database.open_page_count() > 0);
      CHECK(found.closed_pages > 0);
      CHECK((found.open_leaves > 0 || page_size < 1024));
    }
  }
}

TEST_CASE(
    "places that are many lie in open pages, of which no node has to hold all, and the forest grows by few bytes for each") {
  const core::Database few = core::build_database(field_of_balls(4), with_instances(4096)),
                       many = core::build_database(field_of_balls(40), with_instances(4096));
  const std::uint64_t places = many.records().instances - few.records().instances;
  CHECK(places == 40 * 40 - 4 * 4);
  CHECK((many.forest_page_count() - few.forest_page_count()) * 4096 < 8 * places);
  CHECK((many.open_page_count() - few.open_page_count()) * 4096 >= sizeof(core::InstanceRecord) * places);
}

TEST_CASE("a scene without places has no open pages") {
  const core::Scene scene = rug_on_floor(true, true, 6);
  CHECK(core::build_database(scene, with_instances()).open_page_count() == 0);
  CHECK(core::build_database(scene, {}).open_page_count() == 0);
}

}  // namespace dmpc::tests::open_pages_test
