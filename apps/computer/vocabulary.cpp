#include "apps/computer/vocabulary.h"

#include <algorithm>
#include <array>

#include "apps/computer/declared.h"
#include "apps/computer/dmpc/pages.h"
#include "svm/pages/packets.h"

namespace dmpc::apps {
namespace {

using core::Charge;

constexpr std::array<Charge, task_operations_max> free_charges = {
    Charge::ray_setup,   Charge::cell_step, Charge::bvh_node_read, Charge::triangle_test,
    Charge::sphere_test, Charge::cone_test, Charge::shading,       Charge::ray_packing};

NamedPacket named(svm::Kind kind) {
  std::string name = name_of(kind);
  std::replace(name.begin(), name.end(), '_', ' ');
  return {name, name_of(kind), number_of(kind)};
}

}  // namespace

Vocabulary vocabulary_of(const Needs& needs) {
  Vocabulary all;
  for (const PacketNeed& packet : needs.packets) {
    all.packets.push_back({packet.name, packet.name, all.packets.size()});
  }
  for (const OperationNeed& operation : needs.operations) {
    all.operations.push_back({operation.name, all.operations.size(), operation.nanoseconds});
  }
  for (const MemoryNeed& memory : needs.memory) {
    all.memory.push_back(memory.name);
  }
  return all;
}

Vocabulary vocabulary_of_tasks(const std::vector<OperationNeed>& operations) {
  check_operations(operations, task_operations_max, "a program of tasks");
  Vocabulary all = {.packets = {named(svm::Kind::page_request), named(svm::Kind::page_reply)},
                    .operations = {},
                    .of_pages = {{"look-up of a page at home", static_cast<Index>(Charge::home_lookup)},
                                 {"look-up of another page", static_cast<Index>(Charge::cached_lookup)},
                                 {"page put into the cache", static_cast<Index>(Charge::page_install)}},
                    .memory = {}};
  for (const OperationNeed& operation : operations) {
    const auto charge = static_cast<Index>(charge_of(all.operations.size()));
    all.operations.push_back({operation.name, charge, operation.nanoseconds});
  }
  return all;
}

core::Charge charge_of(Index operation) { return free_charges.at(operation); }

}  // namespace dmpc::apps
