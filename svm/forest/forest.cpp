#include "svm/forest/forest.h"

#include <algorithm>
#include <array>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "core/trace/bundle_below.h"
#include "core/trace/charge.h"

namespace dmpc::svm {
namespace {

using nodes::Category;

/// The maximum number of questions in a packet.
constexpr std::uint32_t packet_questions_max = 16;

constexpr std::size_t question_bytes(QuestionKind kind) {
  return sizeof(QuestionHeader) + (kind == QuestionKind::below           ? sizeof(core::Below)
                                   : kind == QuestionKind::below_in_mesh ? sizeof(core::Below) + sizeof(core::ReportedInstance)
                                                                         : sizeof(core::Address));
}

core::RecordKind record_kind(QuestionKind kind) {
  core::expect(!is_about_ray(kind), "a question is about a record");
  return kind == QuestionKind::leaf      ? core::RecordKind::leaf
         : kind == QuestionKind::normals ? core::RecordKind::normals
         : kind == QuestionKind::tile    ? core::RecordKind::tile
                                         : core::RecordKind::bvh_node;
}

QuestionKind question_about(core::RecordKind kind) {
  return kind == core::RecordKind::leaf      ? QuestionKind::leaf
         : kind == core::RecordKind::normals ? QuestionKind::normals
         : kind == core::RecordKind::tile    ? QuestionKind::tile
                                             : QuestionKind::bvh_node;
}

std::size_t answer_bytes_max(QuestionKind kind) {
  return sizeof(AnswerHeader) + (is_about_ray(kind) ? sizeof(core::Hit) : core::bytes_max(record_kind(kind)));
}

/// Appends to the contents of a packet; `end` is where they end.
class PacketWriter {
 public:
  explicit PacketWriter(std::span<std::byte> room) : room_(room) {}

  void add(const void* from, std::size_t bytes) {
    core::expect(end_ + bytes <= room_.size(), "a packet of questions or answers has room for them");
    std::memcpy(room_.data() + end_, from, bytes);
    end_ += bytes;
  }
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(&value, sizeof(value));
  }
  std::span<const std::byte> bytes() const { return room_.first(end_); }
  std::size_t left() const { return room_.size() - end_; }

 private:
  std::span<std::byte> room_;
  std::size_t end_ = 0;
};

/// The size of the open pages that not every node has.
std::size_t asked_open_bytes(const PageCapacity& capacity) {
  return holds_open_pages(capacity.open_pages, capacity.page_size_bytes()) ? 0 : capacity.open_pages * capacity.page_size_bytes();
}

constexpr std::size_t lent_bytes = core::record_bytes_max + core::overread_bytes;

}  // namespace

std::size_t question_packet_bytes(const PageCapacity& capacity) {
  if (capacity.node_count <= 1) {
    return 0;
  }
  const std::uint32_t questions = std::min(capacity.in_flight * capacity.rays_a_task, packet_questions_max);
  const QuestionKind longest = capacity.open_pages > 0 ? QuestionKind::below_in_mesh : QuestionKind::below;
  return std::max(questions * question_bytes(longest), answer_bytes_max(QuestionKind::leaf));
}

nodes::Layout<Forest::Question, Forest::Queue, std::byte, std::byte, core::ReportedInstance, core::RayBundle> Forest::own_layout(
    const PageCapacity& capacity) {
  const std::uint32_t rays = capacity.in_flight * capacity.rays_a_task;
  return {{Category::queues, rays},
          {Category::queues, capacity.node_count},
          {Category::queues, question_packet_bytes(capacity)},
          {Category::queues, lent_bytes},
          {Category::queues, capacity.open_pages > 0 ? rays : 0},
          {core::MemoryUse::ray_stacks, capacity.rays_a_task > 1 ? 1U : 0U}};
}

nodes::MemoryPlan Forest::layout(const PageCapacity& capacity, std::uint32_t index) {
  return nodes::ImmutablePieces::layout(core::MemoryUse::home_pages, capacity.leading_bytes() + core::overread_bytes) +
         HomePages::layout(capacity, index) + own_layout(capacity);
}

Forest::Forest(nodes::Node& node, const PageCapacity& capacity, const nodes::ByteSource& database)
    : geometry_(capacity.page_size_bytes()),
      forest_(nodes::kept(node.memory(), core::MemoryUse::home_pages, database, capacity.leading_bytes(), core::overread_bytes)),
      closed_from_(capacity.leading_bytes() + asked_open_bytes(capacity)),
      homes_(node, capacity, database),
      self_(nodes::index_of(node.id())),
      rays_a_task_(capacity.rays_a_task),
      node_(&node) {
  std::tie(asked_, queues_, packet_, lent_, places_, answered_) = own_layout(capacity).in(node.memory());
  grant_requests(node, capacity);
}

const std::byte* Forest::find_below(core::Address address) {
  if (const std::byte* const page = homes_.find(geometry_.page_of(address))) {
    ++counters_.home_hits;
    return page + geometry_.offset_of(address);
  }
  if (address == lent_address_) {
    return lent_.data();  // counted as a miss when it was requested
  }
  ++counters_.misses;
  return nullptr;
}

void Forest::ask(std::uint32_t slot, const core::Below& below, std::uint32_t behind) {
  ask_below(slot, QuestionKind::below, below, behind);
}

void Forest::ask(std::uint32_t slot, const core::Below& below, const core::ReportedInstance& place) {
  places_[slot] = place;
  ask_below(slot, QuestionKind::below_in_mesh, below, 0);
}

void Forest::ask_below(std::uint32_t slot, QuestionKind kind, const core::Below& below, std::uint32_t behind) {
  asked_[slot].below = below;
  asked_[slot].kind = kind;
  ++questions_counted_.rays_asked;
  add(slot, below.child.address(), behind);
}

void Forest::ask(std::uint32_t slot, core::RecordKind kind, core::Address address) {
  asked_[slot].record = address;
  asked_[slot].kind = question_about(kind);
  ++questions_counted_.records_asked;
  add(slot, address, 0);
}

/// Sends packets only where no more questions of the same bundle follow.
void Forest::add(std::uint32_t slot, core::Address address, std::uint32_t behind) {
  const std::uint32_t owner = homes_.home_of(geometry_.page_of(address));
  core::expect(owner != self_, "what is at home is never asked for");
  Queue& queue = queues_[owner];
  asked_[slot].next = no_slot;
  asked_[slot].behind = static_cast<std::uint8_t>(behind);
  (queue.first == no_slot ? queue.first : asked_[queue.last].next) = slot;
  queue.last = slot;
  ++waiting_;
  ++queue.count;
  if (behind == 0) {
    send_full(owner);
  }
}

void Forest::send_full(std::uint32_t owner) {
  while (queues_[owner].count >= packet_questions_max && send(owner)) {
  }
}

void Forest::flush() {
  for (std::uint32_t i = 1; waiting_ > 0 && i < queues_.size(); ++i) {
    const auto owner = static_cast<std::uint32_t>((self_ + i) % queues_.size());  // so that nodes begin with different ones
    while (queues_[owner].count > 0 && send(owner)) {
    }
  }
}

/// Sends the oldest questions, as many as fit a packet together with their answers, those of a bundle all or none. Returns
/// whether a credit was available.
bool Forest::send(std::uint32_t owner) {
  if (node_->credits(nodes::NodeId{owner}, request_channel) == 0) {
    return false;
  }
  Queue& queue = queues_[owner];
  PacketWriter writer(packet_);
  std::size_t answers_left = packet_.size();
  while (queue.count > 0) {
    const Question& question = asked_[queue.first];
    const std::size_t together = question.behind + std::size_t{1};
    if (together * question_bytes(question.kind) > writer.left() || together * answer_bytes_max(question.kind) > answers_left) {
      break;
    }
    answers_left -= answer_bytes_max(question.kind);
    writer.add(QuestionHeader{.slot = static_cast<std::uint16_t>(queue.first), .kind = question.kind, .behind = question.behind});
    if (!is_about_ray(question.kind)) {
      writer.add(question.record);
    } else {
      writer.add(question.below);
    }
    if (question.kind == QuestionKind::below_in_mesh) {
      writer.add(places_[queue.first]);
    }
    queue.first = question.next;
    --queue.count;
    --waiting_;
    ++under_way_;
  }
  node_->send_reserved(nodes::NodeId{owner}, request_channel, number_of(Kind::questions), writer.bytes());
  return true;
}

void Forest::answer(const nodes::Packet& questions, const core::DatabaseHeader& database, core::Operations& operations) {
  PacketWriter writer(packet_);
  for (std::span<const std::byte> rest = questions.payload; !rest.empty();) {
    const auto header = core::read<QuestionHeader>(rest.data());
    const std::byte* const content = rest.data() + sizeof(header);
    const auto answer_ray = [&](std::uint16_t slot, const core::Hit& hit) {
      writer.add(AnswerHeader{slot, hit.found() ? std::uint16_t{sizeof(hit)} : std::uint16_t{0}});
      if (hit.found()) {
        writer.add(hit);
      }
      ++questions_counted_.rays_answered;
    };
    if (header.behind > 0) {
      rest = answer_together(rest, database, operations, answer_ray);
      continue;
    }
    rest = rest.subspan(question_bytes(header.kind));
    if (is_about_ray(header.kind)) {
      const auto below = core::read<core::Below>(content);
      answer_ray(header.slot, header.kind == QuestionKind::below
                                  ? core::trace_below(below, *this, operations)
                                  : core::trace_below(below, core::read<core::ReportedInstance>(content + sizeof(below)), *this,
                                                      database, operations));
    } else {
      const std::byte* const record = find(core::read<core::Address>(content));
      core::expect(record != nullptr, "a question about a record reaches its owner");
      const std::size_t bytes = core::bytes_of(record_kind(header.kind), record);
      writer.add(AnswerHeader{header.slot, static_cast<std::uint16_t>(bytes)});
      writer.add(record, bytes);
      ++questions_counted_.records_answered;
    }
  }
  node_->grant(questions.source, bulk_channel);
  node_->send_reserved(questions.source, bulk_channel, number_of(Kind::answers), writer.bytes());
}

/// Answers the questions at the beginning that are about rays of one bundle. Returns those behind them.
template <class Answer>
std::span<const std::byte> Forest::answer_together(std::span<const std::byte> questions, const core::DatabaseHeader& database,
                                                   core::Operations& operations, const Answer& answer) {
  constexpr std::size_t each = question_bytes(QuestionKind::below);
  const std::size_t count = core::read<QuestionHeader>(questions.data()).behind + std::size_t{1};
  core::expect(count <= core::bundle_rays_max && rays_a_task_ > 1, "rays that ask together fit a bundle");
  std::array<core::Below, core::bundle_rays_max> rays;
  for (std::size_t i = 0; i < count; ++i) {
    rays[i] = core::read<core::Below>(questions.data() + i * each + sizeof(QuestionHeader));
  }
  core::RayBundle& bundle = answered_.front();
  core::trace_below(bundle, std::span<const core::Below>(rays).first(count), *this, database, operations);
  for (std::size_t i = 0; i < count; ++i) {
    answer(core::read<QuestionHeader>(questions.data() + i * each).slot, core::found_below(bundle, i));
  }
  return questions.subspan(count * each);
}

/// Waiting questions may need the packet's credit.
std::span<const std::byte> Forest::begin_taking(const nodes::Packet& answers) {
  node_->grant(answers.source, request_channel);
  const std::uint32_t owner = nodes::index_of(answers.source);
  send_full(owner);
  return answers.payload;
}

void Forest::lend(core::Address address, std::span<const std::byte> bytes) {
  core::expect(bytes.size() <= core::record_bytes_max, "a record has room where it is lent");
  std::copy(bytes.begin(), bytes.end(), lent_.begin());
  lent_address_ = address;
}

PageCounters Forest::counters() const {
  PageCounters counters = counters_;
  counters.references = counters.home_hits + counters.misses;
  return counters;
}

void Forest::add_charges(nodes::Charges& charges) const {
  const QuestionCounters& questions = questions_counted_;
  charges[core::Charge::question_setup] += questions.rays_asked + questions.rays_answered;
  charges[core::Charge::home_lookup] += counters_.home_hits;
  charges[core::Charge::cached_lookup] += counters_.misses;
  charges[core::Charge::ray_packing] +=
      questions.rays_asked + questions.records_asked + questions.rays_answered + questions.records_answered;
}

}  // namespace dmpc::svm
