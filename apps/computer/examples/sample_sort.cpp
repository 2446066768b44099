// Sorting by regular samples (H. Shi, J. Schaeffer, "Parallel Sorting by Regular Sampling", 1992): every node sorts its keys and
// sends samples to node 0, which assigns a range to each node; then all nodes exchange their keys, in parts.
//
//   sample_sort --keys=4096 --runner=virtual --machine=gigabit --nodes=16
//
// sorts 65,536 keys in 1.06 ms of virtual time, while one node takes 4.46 ms, and 64 nodes with 1,024 keys each take 2.16 ms.
// Result: no node gets more than twice its share, as the article proves, and usually a few percent more; the packets between all
// pairs of nodes, whose number grows with the square of the nodes, limit the speedup.
#include <dmpc/computer.h>

#include <algorithm>
#include <bit>
#include <string>

using Key = std::uint32_t;

enum Packets : dmpc::Index { samples, bounds, part, taken };
enum Operations : dmpc::Index { comparison };
enum Memory : dmpc::Index { keys_here, keys_sorted, sampled };

constexpr std::size_t part_keys = 255;

/// Keys for one node; the last part for a node is marked.
struct Part {
  std::uint32_t is_last = 0;
  Key keys[part_keys];
};

/// All keys differ, since each step is invertible.
Key key_at(std::uint32_t place) {
  Key key = place * 2654435769U;
  key ^= key >> 15U;
  return key * 2246822519U;
}

class SampleSort final : public dmpc::Program {
 public:
  SampleSort(dmpc::Node& node, std::uint32_t keys)
      : node_(node),
        nodes_(node.node_count()),
        keys_(node.allocate<Key>(keys_here, keys)),
        sorted_(node.allocate<Key>(keys_sorted, 2 * std::size_t{keys})),
        samples_(node.allocate<Key>(sampled, std::size_t{nodes_} * nodes_)),
        bounds_(node.allocate<Key>(sampled, nodes_)),
        next_(node.allocate<std::uint32_t>(sampled, nodes_)),
        has_all_(node.allocate<std::uint8_t>(sampled, nodes_)) {
    for (std::uint32_t i = 0; i < keys; ++i) {
      keys_[i] = key_at(node.id() * keys + i);
    }
  }

  void receive(const dmpc::Packet& packet) override {
    if (packet.kind == samples) {
      add_samples(packet);
    } else if (packet.kind == bounds) {
      packet.copy_to(bounds_);
      divide();
    } else if (packet.kind == part) {
      Part keys;
      packet.copy_to(std::span(reinterpret_cast<std::uint32_t*>(&keys), sizeof(keys) / sizeof(std::uint32_t)));
      take(std::span(keys.keys, packet.payload.size() / sizeof(Key) - 1));
      parts_last_ += keys.is_last;
      node_.answer(packet.source, taken);
    }
  }

  bool work() override {
    if (!is_sampled_) {
      sort(keys_);
      send_samples();
      is_sampled_ = true;
      return true;
    }
    if (has_bounds_ && sent_count_ < nodes_) {
      return send_parts();
    }
    if (sent_count_ == nodes_ && parts_last_ + 1 == nodes_ && !is_done_) {
      sort(sorted_.first(sorted_count_));
      is_done_ = true;
    }
    return false;
  }

  bool finished() const override { return is_done_; }
  std::string describe() const override {
    return std::to_string(sent_count_) + " nodes have their keys, " + std::to_string(sorted_count_) + " keys are here";
  }
  std::span<const Key> outcome() const { return sorted_.first(sorted_count_); }

 private:
  void sort(std::span<Key> keys) {
    std::sort(keys.begin(), keys.end());
    node_.charge(comparison, keys.size() * std::bit_width(keys.size()));
  }

  void send_samples() {
    for (std::uint32_t i = 0; i < nodes_; ++i) {
      bounds_[i] = keys_[i * keys_.size() / nodes_];
    }
    if (node_.id() != 0) {
      (void)node_.try_send(0, samples, bounds_);  // sent once in the run, so it never fails
    } else {
      add_samples({.payload = std::as_bytes(bounds_)});
    }
  }

  void add_samples(const dmpc::Packet& packet) {
    packet.copy_to(samples_.subspan(std::size_t{nodes_} * samples_from_));
    if (++samples_from_ == nodes_) {
      sort(samples_);
      for (std::uint32_t i = 0; i < nodes_; ++i) {
        bounds_[i] = samples_[std::size_t{nodes_} * i + nodes_ / 2];
      }
      divide();
      for (std::uint32_t target = 1; target < nodes_; ++target) {
        (void)node_.try_send(target, bounds, bounds_);
      }
    }
  }

  /// Returns the index of the first key for `target`; the first node's keys start at 0.
  std::uint32_t begin_of(std::uint32_t target) const {
    if (target == 0 || target == nodes_) {
      return target == 0 ? 0 : static_cast<std::uint32_t>(keys_.size());
    }
    return static_cast<std::uint32_t>(std::lower_bound(keys_.begin(), keys_.end(), bounds_[target]) - keys_.begin());
  }

  void divide() {
    for (std::uint32_t target = 0; target < nodes_; ++target) {
      next_[target] = begin_of(target);
    }
    has_bounds_ = true;
  }

  /// Sends the next part to every node with space for a packet, first to the next one, so that not all send to the same node.
  bool send_parts() {
    bool has_sent = false;
    for (std::uint32_t i = 0; i < nodes_; ++i) {
      const std::uint32_t target = (node_.id() + i) % nodes_;
      has_sent = (has_all_[target] == 0 && send_part(target)) || has_sent;
    }
    return has_sent;
  }

  bool send_part(std::uint32_t target) {
    const std::uint32_t end = begin_of(target + 1);
    if (target == node_.id()) {
      take(keys_.subspan(next_[target], end - next_[target]));
      next_[target] = end;
    } else {
      Part keys;
      const std::uint32_t count = std::min<std::uint32_t>(part_keys, end - next_[target]);
      keys.is_last = next_[target] + count == end ? 1 : 0;
      std::copy_n(keys_.begin() + next_[target], count, keys.keys);
      if (!node_.try_send(target, part, std::as_bytes(std::span(&keys, 1)).first((count + 1) * sizeof(Key)))) {
        return false;
      }
      next_[target] += count;
    }
    has_all_[target] = next_[target] == end ? 1 : 0;
    sent_count_ += has_all_[target];
    return true;
  }

  void take(std::span<const Key> keys) {
    std::copy(keys.begin(), keys.end(), sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_count_));
    sorted_count_ += keys.size();
  }

  dmpc::Node& node_;
  std::uint32_t nodes_, samples_from_ = 0, sent_count_ = 0, parts_last_ = 0;
  std::span<Key> keys_, sorted_, samples_, bounds_;
  std::span<std::uint32_t> next_;    ///< by target: its first key that is not sent yet
  std::span<std::uint8_t> has_all_;  ///< by target: whether all keys are sent
  std::size_t sorted_count_ = 0;
  bool is_sampled_ = false, has_bounds_ = false, is_done_ = false;
};

/// Checks the order of all nodes' keys; returns their number, and how far the largest node is above the mean.
std::string judged(const std::vector<std::vector<Key>>& of_nodes, std::uint32_t keys) {
  std::vector<Key> all, expected;
  std::size_t most = 0;
  for (const std::vector<Key>& of_node : of_nodes) {
    all.insert(all.end(), of_node.begin(), of_node.end());
    most = std::max(most, of_node.size());
  }
  for (std::uint32_t i = 0; i < keys * of_nodes.size(); ++i) {
    expected.push_back(key_at(i));
  }
  std::sort(expected.begin(), expected.end());
  return std::to_string(all.size()) + " keys" + (all == expected ? ", sorted" : ", NOT SORTED") + "; the fullest node has " +
         std::to_string(100 * most / keys) + " % of its share";
}

int main(int count, char** words) {
  std::uint32_t keys = 10000;
  const auto needs = [&keys](std::uint32_t nodes) -> dmpc::Needs {
    if (keys < nodes) {
      throw dmpc::UsageError("--keys=" + std::to_string(keys) + ": expected at least one for each of " + std::to_string(nodes) +
                             " samples");
    }
    const std::size_t row = nodes * sizeof(Key);
    return {.packets = {{.name = "samples", .bytes_max = row, .senders = dmpc::to_node(0)},
                        {.name = "bounds", .bytes_max = row, .senders = dmpc::from_node(0)},
                        {.name = "part", .bytes_max = sizeof(Part), .senders = dmpc::from_each_other()},
                        {.name = "taken", .answers = "part"}},
            .operations = {{"comparison", 2}},
            .memory = {{"keys", dmpc::bytes_of<Key>(keys)},
                       {"sorted keys", dmpc::bytes_of<Key>(2 * std::size_t{keys})},
                       {"samples", dmpc::bytes_of<Key>(std::size_t{nodes} * nodes) + 2 * dmpc::bytes_of<Key>(nodes) +
                                       dmpc::bytes_of<std::uint8_t>(nodes)}}};
  };
  return dmpc::run<SampleSort>(count, words,
                               {.description = "Sort keys that are distributed over the nodes",
                                .options = {{"--keys", &keys, 1, 1'000'000, "Keys of each node, at least as many as nodes"}},
                                .needs = needs,
                                .make = [&keys](dmpc::Node& node) { return std::make_unique<SampleSort>(node, keys); },
                                .result = [&keys](const auto& of_nodes) { return judged(of_nodes, keys); }});
}
