// Items travel around a ring, from each node to the opposite one, through all nodes between: a node keeps a passing item until
// the next one has space for it. There are two lanes; an item changes from the first to the second when it passes node 0 (W. J.
// Dally, C. L. Seitz, "Deadlock-Free Message Routing in Multiprocessor Interconnection Networks", 1987).
//
//   passing_ring --runner=virtual --machine=hdr --nodes=16
//
// takes 436 us of virtual time, and with two places at each node and lane 235 us. Result: with --lanes=1 --places=2, the same
// number of places, the ring deadlocks as soon as passing items take all places, since each waits for a place that only the next
// node can free. The computer reports which nodes wait for each other. With two lanes no cycle can form: items of the second lane
// go no further than to the node before node 0, so the last of them can always proceed, and then those of the first lane.
#include <dmpc/computer.h>

#include <array>
#include <numeric>
#include <string>

/// The packets of each lane.
enum Packets : dmpc::Index { item, taken, packets_a_lane };
enum Memory : dmpc::Index { passing };

/// The node to which the item goes.
using Item = std::uint32_t;

struct RingOptions {
  std::uint32_t items = 16, places = 1, lanes = 2;
};

/// A first-in, first-out queue of passing items.
struct Lane {
  std::span<Item> items;
  std::uint32_t first = 0, count = 0;

  void add(Item value) { items[(first + count++) % items.size()] = value; }
  void remove() {
    first = static_cast<std::uint32_t>((first + 1) % items.size());
    --count;
  }
};

class PassingRing final : public dmpc::Program {
 public:
  PassingRing(dmpc::Node& node, const RingOptions& options) : node_(node), options_(options) {
    for (Lane& lane : lanes_) {
      lane.items = node.allocate<Item>(passing, options.places);
    }
  }

  void receive(const dmpc::Packet& packet) override {
    if (packet.kind % packets_a_lane == taken) {
      return;  // the computer counts what may be sent
    }
    const std::size_t lane = packet.kind / packets_a_lane;
    const Item arrived = packet.as<Item>();
    if (arrived == node_.id()) {
      ++arrived_;
      node_.answer(packet.source, lane * packets_a_lane + taken);
    } else {
      lanes_[lane].add(arrived);
    }
  }

  bool work() override {
    bool has_moved = false;
    for (std::size_t lane = options_.lanes; lane-- > 0;) {
      if (lanes_[lane].count > 0 && send(lane, lanes_[lane].items[lanes_[lane].first])) {
        lanes_[lane].remove();
        node_.answer(node_.previous(), lane * packets_a_lane + taken);
        has_moved = true;
      }
    }
    if (sent_ < options_.items && send(0, (node_.id() + node_.node_count() / 2) % node_.node_count())) {
      ++sent_;
      has_moved = true;
    }
    return has_moved;
  }

  bool finished() const override {
    return sent_ == options_.items && arrived_ == options_.items && lanes_[0].count + lanes_[1].count == 0;
  }
  std::string describe() const override {
    return std::to_string(sent_) + " sent, " + std::to_string(lanes_[0].count + lanes_[1].count) + " here that pass, " +
           std::to_string(arrived_) + " have come";
  }
  std::uint32_t outcome() const { return arrived_; }

 private:
  /// Sends to the next node, on the last lane if that is node 0.
  bool send(std::size_t lane, Item value) {
    const std::size_t next_lane = node_.next() == 0 ? options_.lanes - 1 : lane;
    return node_.try_send(node_.next(), next_lane * packets_a_lane + item, std::span<const Item>(&value, 1));
  }

  dmpc::Node& node_;
  RingOptions options_;
  std::array<Lane, 2> lanes_;
  std::uint32_t sent_ = 0, arrived_ = 0;
};

int main(int count, char** words) {
  RingOptions ring;
  const auto needs = [&ring](std::uint32_t) -> dmpc::Needs {
    std::vector<dmpc::PacketNeed> packets;
    for (std::uint32_t lane = 1; lane <= ring.lanes; ++lane) {
      const std::string name = " in lane " + std::to_string(lane);
      packets.push_back({.name = "item" + name, .senders = dmpc::from_previous(ring.places)});
      packets.push_back({.name = "taken" + name, .answers = "item" + name});
    }
    return {.packets = packets, .memory = {{"passing", 2 * dmpc::bytes_of<Item>(ring.places)}}};
  };
  const auto result = [](const std::vector<std::uint32_t>& arrived) {
    return std::to_string(std::accumulate(arrived.begin(), arrived.end(), 0U)) + " items have come";
  };
  return dmpc::run<PassingRing>(
      count, words,
      {.description = "Pass items round a ring of nodes",
       .options = {{"--items", &ring.items, 1, 1'000'000, "Items of each node"},
                   {"--places", &ring.places, 1, 1000, "Places at each node and lane for items that pass"},
                   {"--lanes", &ring.lanes, 1, 2, "With 2 items change from the first to the second at node 0"}},
       .needs = needs,
       .make = [&ring](dmpc::Node& node) { return std::make_unique<PassingRing>(node, ring); },
       .result = result});
}
