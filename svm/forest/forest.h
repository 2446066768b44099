// A node's part of the scene with strategy forest: the tree's upper part, like every node, and whole subtrees, about which it
// alone answers questions (J. Goldsmith, J. Salmon, "A Ray Tracing System for the Hypercube", Caltech 1985; J. Salmon, J.
// Goldsmith, "A Hypercube Ray-tracer", 1988).
//
// Invariants: (1) a page after the forest holds everything below its part of the tree, so its home answers from its own memory at
// once, and waits for nothing; (2) a ray waits for at most one answer, so there are never more questions than slots; (3)
// packets of questions are answered one by one, so that an answer's slot is reserved by its questions. Invariant (1) does not
// hold for open pages, which lead into base meshes: if there are few, every node has them, otherwise a traversal asks for one
// record after the other, and goes on by itself; in a mesh (1) holds again, and the question includes the instance.
//
// Questions and answers between nodes of strategy forest are values, without pointers. A packet has as many as fill it. Rays that
// share a bundle ask together, and their questions stay together in one packet, so that the owner traces them together, too.
//
//   kind                   from -> to          channel   size   its slot in the target's mailbox is reserved by
//   questions              node -> owner       request   any    the sender's request credits for that owner
//   answers                owner -> node       bulk      any    the questions
//
// They replace page requests and replies (svm/pages/packets.h), and have their numbers. They may be small or bulk: their credits
// reserve slots of both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "core/record/record_kind.h"
#include "core/record/records.h"
#include "core/trace/below.h"
#include "core/trace/below_in_mesh.h"
#include "core/trace/bundle.h"
#include "core/trace/operations.h"
#include "nodes/immutable_pieces.h"
#include "nodes/layout.h"
#include "nodes/node.h"
#include "svm/pages/faults.h"
#include "svm/pages/home_pages.h"
#include "svm/pages/node_program.h"
#include "svm/pages/packets.h"
#include "svm/pages/page.h"
#include "svm/pages/page_capacity.h"
#include "svm/pages/plain_records.h"

namespace dmpc::svm {

/// What a question asks for: what a ray hits below a child, outside of base meshes or in one, or a record.
enum class QuestionKind : std::uint8_t { below, leaf, normals, tile, bvh_node, below_in_mesh };

/// Whether it is about a ray.
constexpr bool is_about_ray(QuestionKind kind) { return kind == QuestionKind::below || kind == QuestionKind::below_in_mesh; }

/// Precedes a core::Below, in a mesh followed by a core::ReportedInstance, or, for a record, its core::Address.
struct QuestionHeader {
  std::uint16_t slot = 0;  ///< the question's, for the answer
  QuestionKind kind{};
  std::uint8_t behind = 0;  ///< how many of the questions after this one are about rays of the same bundle
};
static_assert(sizeof(QuestionHeader) == 4);

/// Precedes as many bytes: a core::Hit, if there is a nearer one, or the record. A packet answers a packet.
struct AnswerHeader {
  std::uint16_t slot = 0;
  std::uint16_t bytes = 0;
};
static_assert(sizeof(AnswerHeader) == 4);

/// The maximum size of open pages for every node to hold them like the forest: so few records are read by many rays, each of
/// which would ask for them one by one.
inline constexpr std::size_t held_open_bytes_max = std::size_t{256} << 10U;
constexpr bool holds_open_pages(std::uint32_t count, std::size_t page_size_bytes) {
  return count * page_size_bytes <= held_open_bytes_max;
}

/// The size of a full packet of questions, and of its answers; 0 if there is nobody to ask.
std::size_t question_packet_bytes(const PageCapacity& capacity);

/// A core::Records whose find() returns nullptr for a record that is neither in the forest nor at home, unless its owner has just
/// sent it. Questions to owners are sent in packets when they are full or there is nothing else to do. Not thread-safe.
class Forest : public PlainRecords {
 public:
  static constexpr const char* awaited = "answers";

  /// Puts the forest and the node's home pages, from `database`, into its local memory (nodes/immutable_pieces.h), and takes the
  /// credits for its questions.
  Forest(nodes::Node& node, const PageCapacity& capacity, const nodes::ByteSource& database);
  /// The memory that the constructor takes at node `index`.
  static nodes::MemoryPlan layout(const PageCapacity& capacity, std::uint32_t index);

  /// The pointer is valid until the next packet of answers is taken.
  const std::byte* find(core::Address address) {
    const std::uint64_t offset = core::byte_offset(address);
    if (offset < forest_.size()) {
      ++counters_.home_hits;
      return forest_.data() + offset;
    }
    return find_below(address);
  }

  /// Answers questions, or takes answers and continues all pixels that wait for them. Returns false for any other packet.
  /// `waiting`, also below, is a node program of core::PixelTasks.
  template <class Waiting>
  bool receive(const nodes::Packet& packet, Waiting& waiting) {
    switch (Kind{packet.kind}) {
      case Kind::questions:
        answer(packet, waiting.settings().header, waiting.operations());
        return true;
      case Kind::answers:
        take(packet, [this, &waiting](std::uint32_t slot, const core::Hit* hit) {
          const std::uint32_t task = slot / rays_a_task_;
          if (hit == nullptr || take_below(waiting.task(task), slot % rays_a_task_, *hit, waiting)) {
            waiting.go_on(task);
          }
        });
        return true;
      default:
        return false;
    }
  }
  /// Asks for what the pixel in `slot` needs.
  template <class Waiting>
  void lacks(std::uint32_t slot, Waiting& waiting) {
    const auto& task = waiting.task(slot);
    const std::uint32_t first = slot * rays_a_task_;
    if (!task.is_tracing() || is_open(task.absent())) {
      return ask(first, task.absent_kind(), task.absent());
    }
    if constexpr (is_single<decltype(task)>) {
      if (const auto place = task.instance_of_traversal()) {
        ask(first, task.below(waiting.settings().skips), *place);
      } else {
        ask(first, task.below(waiting.settings().skips));
      }
    } else {
      task.for_each_below(
          [&](std::uint32_t ray, const core::Below& below, std::uint32_t behind) { ask(first + ray, below, behind); });
    }
  }
  /// Asks, as question `slot`, what a ray hits below a child that find() has just reported absent. `behind`: how many questions
  /// about rays of the same bundle follow.
  void ask(std::uint32_t slot, const core::Below& below, std::uint32_t behind = 0);
  /// As above, in a mesh, by its instance.
  void ask(std::uint32_t slot, const core::Below& below, const core::ReportedInstance& place);
  /// Asks for a record that find() has just reported absent, for `slot`.
  void ask(std::uint32_t slot, core::RecordKind kind, core::Address address);
  /// Sends all questions, in full packets or not, as far as credits go.
  void flush();

  /// Answers a packet of questions at once. `header`: the database's. The work of tracing them is added to `operations`.
  void answer(const nodes::Packet& questions, const core::DatabaseHeader& header, core::Operations& operations);
  /// Takes a packet of answers: calls go_on(slot, hit) for each; `hit` is the result of trace_below(), or nullptr if it is a
  /// record, which find() then finds until go_on() returns.
  template <class GoOn>
  void take(const nodes::Packet& answers, const GoOn& go_on) {
    std::span<const std::byte> rest = begin_taking(answers);
    while (!rest.empty()) {
      const auto header = core::read<AnswerHeader>(rest.data());
      const std::span<const std::byte> bytes = rest.subspan(sizeof(header), header.bytes);
      rest = rest.subspan(sizeof(header) + header.bytes);
      ++questions_counted_.answers;
      --under_way_;
      if (is_about_ray(asked_[header.slot].kind)) {
        const core::Hit hit = bytes.empty() ? core::Hit{} : core::read<core::Hit>(bytes.data());
        go_on(std::uint32_t{header.slot}, &hit);
      } else {
        lend(asked_[header.slot].record, bytes);
        go_on(std::uint32_t{header.slot}, static_cast<const core::Hit*>(nullptr));
        lent_address_ = core::no_address;
      }
    }
  }

  /// Questions without an answer, sent or not.
  std::uint32_t pending() const { return waiting_ + under_way_; }
  /// References are look-ups; misses are those that were asked of an owner.
  PageCounters counters() const;
  const QuestionCounters& questions() const { return questions_counted_; }
  void add_charges(nodes::Charges& charges) const;
  nodes::Levels levels() const { return {{"questions pending", pending()}}; }

 private:
  struct Question {
    core::Below below;
    core::Address record = core::no_address;
    QuestionKind kind{};
    std::uint8_t behind = 0;       ///< as in QuestionHeader
    std::uint32_t next = no_slot;  ///< the next slot that waits for the same owner
  };
  /// Questions to be sent to one owner, by slot, in the order of their arrival.
  struct Queue {
    std::uint32_t first = no_slot, last = no_slot;
    std::uint32_t count = 0;
  };

  template <class Task>
  static constexpr bool is_single = std::decay_t<Task>::pixels_max == 1;
  /// Whether the task has what it waits for, and goes on.
  template <class Task, class Waiting>
  static bool take_below(Task& task, std::uint32_t ray, const core::Hit& found, Waiting& waiting) {
    if constexpr (is_single<Task>) {
      task.take_below(found, waiting.settings().skips, waiting.operations());
      return true;
    } else {
      return task.take_below(ray, found, waiting.operations());
    }
  }

  static nodes::Layout<Question, Queue, std::byte, std::byte, core::ReportedInstance, core::RayBundle> own_layout(
      const PageCapacity& capacity);
  const std::byte* find_below(core::Address address);
  /// For a record that is not in the forest.
  bool is_open(core::Address address) const { return core::byte_offset(address) < closed_from_; }
  void ask_below(std::uint32_t slot, QuestionKind kind, const core::Below& below, std::uint32_t behind);
  void add(std::uint32_t slot, core::Address address, std::uint32_t behind);
  void send_full(std::uint32_t owner);
  bool send(std::uint32_t owner);
  template <class Answer>
  std::span<const std::byte> answer_together(std::span<const std::byte> questions, const core::DatabaseHeader& database,
                                             core::Operations& operations, const Answer& answer);
  std::span<const std::byte> begin_taking(const nodes::Packet& answers);
  void lend(core::Address address, std::span<const std::byte> bytes);

  PageGeometry geometry_;
  std::span<const std::byte> forest_;
  std::uint64_t closed_from_;  ///< from here on pages hold everything below their records
  HomePages homes_;
  std::uint32_t self_;
  std::uint32_t rays_a_task_;
  PageCounters counters_;
  QuestionCounters questions_counted_;
  nodes::Node* node_;
  std::span<Question> asked_;  ///< by slot
  std::span<Queue> queues_;    ///< by owner
  std::span<std::byte> packet_;
  std::span<std::byte> lent_;
  std::span<core::ReportedInstance> places_;  ///< for questions in meshes, by slot
  std::span<core::RayBundle> answered_;       ///< one, for rays that are answered together
  core::Address lent_address_ = core::no_address;
  std::uint32_t waiting_ = 0, under_way_ = 0;
};
static_assert(core::Records<Forest>);

}  // namespace dmpc::svm
