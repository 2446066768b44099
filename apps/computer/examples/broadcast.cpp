// Node 0 has data that all nodes need: a broadcast down a tree of any shape, in one or more pieces.
//
//   broadcast --bytes=1000000 --runner=virtual --machine=hdr --nodes=16
//
// takes 173 us of virtual time down a binomial tree, in which each node with the data sends them to one without them, round after
// round. With --children=1 the tree is a chain, and takes 648 us; with --pieces=64 as well, 75.3 us. Result: the time of a short
// message depends on the depth of the tree, that of a long one on what each node has to send, and --pieces=N makes a chain the
// best tree for the longest messages, since a node forwards a piece while the next one arrives (R. Thakur, R. Rabenseifner, W.
// Gropp, "Optimization of Collective Communication Operations in MPICH", 2005). On two nodes it measures the time of a message.
#include <dmpc/computer.h>

#include <algorithm>
#include <bit>
#include <string>

enum Packets : dmpc::Index { piece };
enum Memory : dmpc::Index { pieces, order };

struct Tree {
  std::uint32_t bytes = 65536, children = 0, pieces = 1;

  /// Returns the size of a piece with its number in front.
  std::size_t piece_bytes() const { return sizeof(std::uint32_t) + (bytes + pieces - 1) / pieces; }

  /// Returns the `i`-th child of `node`, if below the number of nodes. In round r of a binomial tree nodes below 2^r send to the
  /// node 2^r further.
  std::uint64_t child(std::uint32_t node, std::uint32_t i) const {
    return children > 0 ? std::uint64_t{node} * children + i + 1 : node + (std::uint64_t{1} << (std::bit_width(node) + i));
  }
  std::uint32_t child_count(std::uint32_t node, std::uint32_t node_count) const {
    std::uint32_t count = 0;
    while ((children == 0 || count < children) && child(node, count) < node_count) {
      ++count;
    }
    return count;
  }
};

/// Returns byte `i` of a piece's data.
std::byte byte_of(std::uint32_t number, std::size_t i) { return static_cast<std::byte>((7 * std::size_t{number} + i) % 251); }

class Broadcast final : public dmpc::Program {
 public:
  Broadcast(dmpc::Node& node, const Tree& tree)
      : node_(node),
        tree_(tree),
        child_count_(tree.child_count(node.id(), node.node_count())),
        pieces_(node.allocate<std::byte>(pieces, tree.pieces * tree.piece_bytes())),
        order_(node.allocate<std::uint32_t>(order, tree.pieces)) {
    if (node.id() == 0) {
      for (std::uint32_t number = 0; number < tree.pieces; ++number) {
        fill(number);
      }
    }
  }

  void receive(const dmpc::Packet& packet) override {
    std::uint32_t number = 0;
    std::memcpy(&number, packet.payload.data(), sizeof(number));
    packet.copy_to(at(number));
    order_[here_++] = number;
  }

  /// Sends one piece to one child; all children get a piece before the next one is sent.
  bool work() override {
    if (sent_ == here_ * child_count_) {
      return false;
    }
    const std::uint32_t number = order_[sent_ / child_count_];
    const auto child = static_cast<std::uint32_t>(tree_.child(node_.id(), sent_ % child_count_));
    if (!node_.try_send(child, piece, std::span<const std::byte>(at(number)))) {
      throw dmpc::ProgramError("a child takes each piece once");
    }
    ++sent_;
    return sent_ < here_ * child_count_;
  }

  bool finished() const override { return here_ == tree_.pieces && sent_ == here_ * child_count_; }
  std::string describe() const override {
    return std::to_string(here_) + " pieces here, " + std::to_string(sent_) + " sent to " + std::to_string(child_count_) +
           " children";
  }

  /// Returns whether all received data equal node 0's.
  std::uint32_t outcome() const {
    for (std::uint32_t number = 0; number < tree_.pieces; ++number) {
      for (std::size_t i = sizeof(number); i < tree_.piece_bytes(); ++i) {
        if (at(number)[i] != byte_of(number, i)) {
          return 0;
        }
      }
    }
    return 1;
  }

 private:
  std::span<std::byte> at(std::uint32_t number) const {
    return pieces_.subspan(number * tree_.piece_bytes(), tree_.piece_bytes());
  }

  void fill(std::uint32_t number) {
    const std::span<std::byte> bytes = at(number);
    std::memcpy(bytes.data(), &number, sizeof(number));
    for (std::size_t i = sizeof(number); i < bytes.size(); ++i) {
      bytes[i] = byte_of(number, i);
    }
    order_[here_++] = number;
  }

  dmpc::Node& node_;
  Tree tree_;
  std::uint32_t child_count_, here_ = 0, sent_ = 0;
  std::span<std::byte> pieces_;     ///< each after its number
  std::span<std::uint32_t> order_;  ///< order of arrival
};

int main(int count, char** words) {
  Tree tree;
  const auto needs = [&tree](std::uint32_t) -> dmpc::Needs {
    if (tree.pieces > tree.bytes) {
      throw dmpc::UsageError("--pieces=" + std::to_string(tree.pieces) + ": expected at most one for each of the " +
                             std::to_string(tree.bytes) + " bytes");
    }
    const auto senders = [&tree](std::uint32_t source, std::uint32_t target, std::uint32_t node_count) {
      for (std::uint32_t i = 0; i < tree.child_count(source, node_count); ++i) {
        if (tree.child(source, i) == target) {
          return tree.pieces;
        }
      }
      return 0U;
    };
    return {.packets = {{.name = "piece", .bytes_max = tree.piece_bytes(), .senders = senders}},
            .memory = {{"pieces", dmpc::bytes_of<std::byte>(tree.pieces * tree.piece_bytes())},
                       {"order", dmpc::bytes_of<std::uint32_t>(tree.pieces)}}};
  };
  const auto result = [&tree](const std::vector<std::uint32_t>& are_right) {
    const auto right = static_cast<std::size_t>(std::count(are_right.begin(), are_right.end(), 1U));
    return std::to_string(right) + " of " + std::to_string(are_right.size()) + " nodes have the " + std::to_string(tree.bytes) +
           " bytes" + (right == are_right.size() ? "" : ", WRONG");
  };
  return dmpc::run<Broadcast>(
      count, words,
      {.description = "Broadcast data of node 0 to all nodes",
       .options = {{"--bytes", &tree.bytes, 1, 1U << 24U, "Size of the data"},
                   {"--children", &tree.children, 0, 4095, "Children of a node of the tree: 1 is a chain, 0 a binomial tree"},
                   {"--pieces", &tree.pieces, 1, 1024, "Number of pieces in which the data are sent, one after the other"}},
       .needs = needs,
       .make = [&tree](dmpc::Node& node) { return std::make_unique<Broadcast>(node, tree); },
       .result = result});
}
