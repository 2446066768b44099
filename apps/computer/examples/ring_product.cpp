// C = A B on a ring: every node keeps its rows of A and C, and blocks of rows of B move around the ring. While a node multiplies,
// its next block is already on its way.
//
//   ring_product --size=128 --runner=virtual --machine=hdr --nodes=16
//
// takes 83.5 us of virtual time, while one node takes 1.05 ms, and 64 nodes take 219 us: the multiplications of a step decrease
// with the square of the nodes, but the cost of a message does not, and there are more steps. Result: a ring pays as long as a
// step's multiplications take longer than a message, and a larger matrix moves that limit.
#include <dmpc/computer.h>

#include <algorithm>
#include <string>

enum Packets : dmpc::Index { block, taken };
enum Operations : dmpc::Index { multiply_add };
enum Memory : dmpc::Index { matrices };

/// Small integers, so that sums have no rounding.
double a_at(std::size_t row, std::size_t column) { return static_cast<double>((row + column) % 7); }
double b_at(std::size_t row, std::size_t column) { return static_cast<double>((3 * row + column) % 5); }

class RingProduct final : public dmpc::Program {
 public:
  RingProduct(dmpc::Node& node, std::uint32_t size)
      : node_(node), size_(size), rows_(size / node.node_count()), owner_(node.id()) {
    for (std::span<double>* matrix : {&a_, &b_, &c_, &next_b_}) {
      *matrix = node.allocate<double>(matrices, rows_ * size_);
    }
    for (std::size_t i = 0; i < rows_ * size_; ++i) {
      a_[i] = a_at(node.id() * rows_ + i / size_, i % size_);
      b_[i] = b_at(node.id() * rows_ + i / size_, i % size_);
    }
  }

  void receive(const dmpc::Packet& packet) override {
    if (packet.kind == block) {
      packet.copy_to(next_b_);
      has_next_ = true;
    }
  }

  bool work() override {
    if (!is_sent_ && !is_last_step()) {
      is_sent_ = node_.try_send(node_.next(), block, b_);
    }
    if (row_ < rows_) {
      multiply(row_++);
      return true;
    }
    if (is_last_step()) {
      is_done_ = true;
    } else if (is_sent_ && has_next_) {
      take_next();
      return true;
    }
    return false;
  }

  bool finished() const override { return is_done_; }
  std::string describe() const override { return "step " + std::to_string(step_) + ", row " + std::to_string(row_); }
  double outcome() const {
    double sum = 0;
    for (const double value : c_) {
      sum += value;
    }
    return sum;
  }

 private:
  bool is_last_step() const { return step_ + 1 == node_.node_count(); }

  void multiply(std::size_t row) {
    for (std::size_t k = 0; k < rows_; ++k) {
      const double factor = a_[row * size_ + owner_ * rows_ + k];
      for (std::size_t column = 0; column < size_; ++column) {
        c_[row * size_ + column] += factor * b_[k * size_ + column];
      }
    }
    node_.charge(multiply_add, rows_ * size_);
  }

  void take_next() {
    std::copy(next_b_.begin(), next_b_.end(), b_.begin());
    node_.answer(node_.previous(), taken);
    owner_ = (owner_ + node_.node_count() - 1) % node_.node_count();
    ++step_;
    row_ = 0;
    is_sent_ = has_next_ = false;
  }

  dmpc::Node& node_;
  std::size_t size_, rows_, row_ = 0;
  std::uint32_t owner_, step_ = 0;  ///< owner_: the node whose rows of B are here
  bool is_sent_ = false, has_next_ = false, is_done_ = false;
  std::span<double> a_, b_, c_, next_b_;
};

/// Returns the sum over C, without multiplying matrices.
double expected_sum(std::size_t size) {
  double sum = 0;
  for (std::size_t k = 0; k < size; ++k) {
    double of_a = 0, of_b = 0;
    for (std::size_t i = 0; i < size; ++i) {
      of_a += a_at(i, k);
      of_b += b_at(k, i);
    }
    sum += of_a * of_b;
  }
  return sum;
}

int main(int count, char** words) {
  std::uint32_t size = 256;
  const auto needs = [&size](std::uint32_t nodes) -> dmpc::Needs {
    if (size % nodes != 0) {
      throw dmpc::UsageError("--size=" + std::to_string(size) + ": expected a multiple of the " + std::to_string(nodes) +
                             " nodes");
    }
    const std::size_t block_values = std::size_t{size} / nodes * size;
    return {.packets = {{.name = "block", .bytes_max = block_values * sizeof(double), .senders = dmpc::from_previous()},
                        {.name = "taken", .answers = "block"}},
            .operations = {{"multiply_add", 0.5}},
            .memory = {{"matrices", 4 * dmpc::bytes_of<double>(block_values)}}};
  };
  const auto result = [&size](const std::vector<double>& sums) {
    double sum = 0;
    for (const double of_node : sums) {
      sum += of_node;
    }
    return "sum of C: " + std::to_string(sum) + (sum == expected_sum(size) ? ", as expected" : ", WRONG");
  };
  return dmpc::run<RingProduct>(
      count, words,
      {.description = "Multiply two matrices on a ring of nodes",
       .options = {{"--size", &size, 1, 4096, "Rows and columns of the matrices, a multiple of the number of nodes"}},
       .needs = needs,
       .make = [&size](dmpc::Node& node) { return std::make_unique<RingProduct>(node, size); },
       .result = result});
}
