// What a node has of the scene with strategy forest: the tree's upper part, as every node, and whole subtrees, of which it alone
// answers questions (J. Goldsmith, J. Salmon, "A Ray Tracing System for the Hypercube", Caltech 1985; J. Salmon, J. Goldsmith, "A
// Hypercube Ray-tracer", 1988).
//
// Invariants: (1) what lies in a page behind the forest holds all that is below it in the tree, so its home answers from its own
// memory at once, and waits for nothing; (2) a pixel waits for one answer at most, so there are never more questions than slots;
// (3) packets of questions are answered one by one, so that an answer's place is reserved by its questions. Pages that lead into
// base meshes are open, which (1) does not hold for: few are at every node, of more a walk asks for one record after the other,
// and goes on by itself; in a mesh (1) holds again, and the question tells where the mesh stands.
//
// What nodes of strategy forest ask each other, and answer: values, without pointers. A packet has as many as fill it.
//
//   kind                   from -> to          channel   size   its place in the target's mailbox is reserved by
//   questions              node -> owner       request   any    the sender's request credits for that owner
//   answers                owner -> node       bulk      any    the questions
//
// They stand in place of page requests and replies (svm/pages/packets.h), which has their numbers. They are small or bulk, as it
// comes: their credits reserve places of both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/record/record_kind.h"
#include "core/record/records.h"
#include "core/trace/below.h"
#include "core/trace/below_in_mesh.h"
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

/// What a question asks for: what a ray meets below a child, outside of base meshes or in one, or a record.
enum class QuestionKind : std::uint8_t { below, leaf, normals, tile, bvh_node, below_in_mesh };

/// Whether it is about a ray.
constexpr bool is_about_ray(QuestionKind kind) { return kind == QuestionKind::below || kind == QuestionKind::below_in_mesh; }

/// Stands before a core::Below, in a mesh with a core::ReportedInstance behind, or, of a record, its core::Address.
struct QuestionHeader {
  std::uint16_t slot = 0;  ///< of the pixel that waits, for the answer
  QuestionKind kind{};
  std::uint8_t padding = 0;
};
static_assert(sizeof(QuestionHeader) == 4);

/// Stands before as many bytes: a core::Hit, if there is something nearer, or the record. A packet answers a packet.
struct AnswerHeader {
  std::uint16_t slot = 0;
  std::uint16_t bytes = 0;
};
static_assert(sizeof(AnswerHeader) == 4);

/// Open pages that every node holds as the forest, at most: records that are so few are met by many rays, each of which would ask
/// for them one by one.
inline constexpr std::size_t held_open_bytes_max = std::size_t{256} << 10U;
constexpr bool holds_open_pages(std::uint32_t count, std::size_t page_size_bytes) {
  return count * page_size_bytes <= held_open_bytes_max;
}

/// The room that a full packet of questions takes, as that of its answers; none if there is nobody to ask.
std::size_t question_packet_bytes(const PageCapacity& capacity);

/// A core::Records whose find() answers nullptr for a record that is neither in the forest nor at home, unless its owner has just
/// sent it. What a pixel waits for is asked of the owner, in packets that leave when they are full or there is nothing else to
/// do. Thread safety: none.
class Forest : public PlainRecords {
 public:
  static constexpr const char* awaited = "answers";

  /// Puts the forest and the node's home pages, from `database`, into its local memory (nodes/immutable_pieces.h), and takes the
  /// credits for its questions.
  Forest(nodes::Node& node, const PageCapacity& capacity, const nodes::ByteSource& database);
  /// What the constructor takes at node `index`.
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

  /// Answers questions, or takes answers and has all go on that wait for them. Returns false for any other packet. `waiting`,
  /// here and below, is a node program of core::PixelTasks.
  template <class Waiting>
  bool receive(const nodes::Packet& packet, Waiting& waiting) {
    switch (Kind{packet.kind}) {
      case Kind::questions:
        answer(packet, waiting.settings().header, waiting.operations());
        return true;
      case Kind::answers:
        take(packet, [&waiting](std::uint32_t slot, const core::Hit* hit) {
          if (hit != nullptr) {
            waiting.task(slot).take_below(*hit, waiting.settings().skips, waiting.operations());
          }
          waiting.go_on(slot);
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
    if (!task.is_tracing() || is_open(task.absent())) {
      ask(slot, task.absent_kind(), task.absent());
    } else if (const auto place = task.instance_of_traversal()) {
      ask(slot, task.below(waiting.settings().skips), *place);
    } else {
      ask(slot, task.below(waiting.settings().skips));
    }
  }
  /// `slot` goes on when it is known what its ray meets below a child, which find() has just said is absent.
  void ask(std::uint32_t slot, const core::Below& below);
  /// The same in a mesh that stands there.
  void ask(std::uint32_t slot, const core::Below& below, const core::ReportedInstance& place);
  /// `slot` goes on when the record, of which find() has just said the same, has come.
  void ask(std::uint32_t slot, core::RecordKind kind, core::Address address);
  /// Sends what is asked, in full packets or not, as far as credits go.
  void flush();

  /// Answers a packet of questions at once. `header`: the database's. What it takes to trace them is added to `operations`.
  void answer(const nodes::Packet& questions, const core::DatabaseHeader& header, core::Operations& operations);
  /// Takes a packet of answers: calls go_on(slot, hit) for each; `hit` is what trace_below() has found, or nullptr if a record
  /// has come, which find() then finds until go_on() returns.
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
  /// References are look-ups; misses those that were asked of an owner.
  PageCounters counters() const;
  const QuestionCounters& questions() const { return questions_counted_; }
  void add_charges(nodes::Charges& charges) const;
  nodes::Levels levels() const { return {{"questions pending", pending()}}; }

 private:
  struct Question {
    core::Below below;
    core::Address record = core::no_address;
    QuestionKind kind{};
    std::uint32_t next = no_slot;  ///< that waits for the same owner
  };
  /// Questions that wait to be sent to one owner, by slot, in the order in which they came.
  struct Queue {
    std::uint32_t first = no_slot, last = no_slot;
    std::uint32_t count = 0;
  };

  static nodes::Layout<Question, Queue, std::byte, std::byte, core::ReportedInstance> own_layout(const PageCapacity& capacity);
  const std::byte* find_below(core::Address address);
  /// Of a record that is not in the forest.
  bool is_open(core::Address address) const { return core::byte_offset(address) < closed_from_; }
  void ask_below(std::uint32_t slot, QuestionKind kind, const core::Below& below);
  void add(std::uint32_t slot, core::Address address);
  bool send(std::uint32_t owner);
  std::span<const std::byte> begin_taking(const nodes::Packet& answers);
  void lend(core::Address address, std::span<const std::byte> bytes);

  PageGeometry geometry_;
  std::span<const std::byte> forest_;
  std::uint64_t closed_from_;  ///< where pages begin that hold all that is below their records
  HomePages homes_;
  std::uint32_t self_;
  PageCounters counters_;
  QuestionCounters questions_counted_;
  nodes::Node* node_;
  std::span<Question> asked_;  ///< by slot
  std::span<Queue> queues_;    ///< by owner
  std::span<std::byte> packet_;
  std::span<std::byte> lent_;
  std::span<core::ReportedInstance> places_;  ///< of questions in meshes, by slot
  core::Address lent_address_ = core::no_address;
  std::uint32_t waiting_ = 0, under_way_ = 0;
};
static_assert(core::Records<Forest>);

}  // namespace dmpc::svm
