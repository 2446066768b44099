#include "svm/work_source.h"

#include <algorithm>
#include <utility>

#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "core/base/units.h"

namespace dmpc::svm {
namespace {

PixelRectangle own_share(const WorkShape& shape, std::uint32_t index) {
  return share_of({0, 0, shape.width, shape.height}, index, shape.dealer ? 0 : shape.worker_count, shape.shares);
}

/// At least one, so that a node without pixels also has a mask.
std::size_t mask_pixels(const WorkShape& shape, std::uint32_t index) {
  return shape.is_masked ? std::max<std::size_t>(own_share(shape, index).pixel_count(), 1) : 0;
}

std::uint64_t bits_of(const ItemSteps& steps) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    bits |= std::uint64_t{steps[i].is_none() ? 0U : 1U} << i;
  }
  return bits;
}

/// Others are passed on along the ring.
constexpr std::size_t kept_max = 16;

/// Different for each node, since mixing is invertible.
std::uint64_t rank_of(std::uint32_t node) { return core::mix(node); }

/// A node that gives no work away has its share as one item, or in masked ones.
std::uint32_t item_side_of(const WorkShape& shape) {
  return shape.is_masked && shape.item_side == 0 ? masked_side_max : shape.item_side;
}

bool is_alone(const WorkShape& shape, std::uint32_t index) {
  return index >= shape.worker_count || (!shape.dealer && (shape.item_side == 0 || shape.worker_count == 1));
}

}  // namespace

WorkSource::WorkSource(nodes::Node& node, const WorkShape& shape, bool passes_over_idle)
    : node_(&node),
      worker_count_(shape.worker_count),
      self_(nodes::index_of(node.id())),
      image_width_(shape.width),
      item_side_(item_side_of(shape)),
      passes_over_idle_(passes_over_idle),
      tile_(shape.tile),
      share_(own_share(shape, self_)),
      items_(share_, item_side_),
      first_donor_(shape.dealer.value_or((self_ + 1) % worker_count_)),
      last_donor_(first_donor_),
      is_alone_(is_alone(shape, self_)),
      no_more_(is_alone_) {
  std::tie(mask_, kept_) = layout(shape, self_).in(node.memory());
  std::fill(mask_.begin(), mask_.end(), core::SampleStep::first());
  if (shape.start != nullptr) {
    want_missing(*shape.start);
  }
}

/// From the host's message before the start.
void WorkSource::want_missing(const core::PartialPicture& start) {
  for (std::uint64_t i = 0; i < share_.pixel_count(); ++i) {
    const std::uint32_t pixel = share_.pixel_at(i, image_width_);
    mask_[i] = start.done.has(pixel) ? core::SampleStep() : start.pass.steps()[pixel];
  }
  skip_unwanted();
}

nodes::Layout<core::SampleStep, WorkRequest> WorkSource::layout(const WorkShape& shape, std::uint32_t index) {
  return {{nodes::Category::queues, mask_pixels(shape, index)}, {nodes::Category::queues, kept_max}};
}

void WorkSource::take_mask(const MaskPart& part) {
  core::expect(exhausted() && part.first_pixel < mask_.size(), "a mask is the next pass's, and the share's");
  const std::size_t count = std::min(part.steps.size(), mask_.size() - part.first_pixel);
  std::copy_n(part.steps.begin(), count, mask_.begin() + part.first_pixel);
}

void WorkSource::begin_pass() {
  core::expect(exhausted() && !asking_, "a pass begins when the one before has ended");
  items_ = WorkItems(share_, item_side_);
  last_donor_ = first_donor_;
  no_more_ = is_alone_;
  ++pass_;
  skip_unwanted();
}

void WorkSource::begin_frame() {
  std::fill(mask_.begin(), mask_.end(), core::SampleStep::first());
  begin_pass();
}

ItemSteps WorkSource::steps_of(const PixelRectangle& item) const {
  ItemSteps steps;
  auto step = steps.begin();
  const std::uint64_t column = (item.x - share_.x) / share_.step_x, row = (item.y - share_.y) / share_.step_y;
  for (std::uint32_t y = 0; y < item.height && is_masked(); ++y) {
    const std::uint64_t index = (row + y) * share_.width + column;
    step = std::copy_n(mask_.begin() + static_cast<std::ptrdiff_t>(index), item.width, step);
  }
  return steps;
}

bool WorkSource::is_wanted(const PixelRectangle& item) const { return !is_masked() || bits_of(steps_of(item)) != 0; }

void WorkSource::open(const PixelRectangle& item, const ItemSteps& steps) {
  steps_ = steps;
  scan_ = is_masked() ? PixelScan(item, tile_, bits_of(steps)) : PixelScan(item, tile_);
}

/// Opens the next item if the current one has no pixel left.
void WorkSource::open_next() {
  if (scan_.empty()) {
    const auto item = items_.take();
    core::expect(item.has_value(), "a node takes pixels only while it has some");
    open(*item, steps_of(*item));
    skip_unwanted();
  }
}

/// Ensures that the first remaining item, if any, has a pixel.
void WorkSource::skip_unwanted() {
  while (!items_.empty() && !is_wanted(*items_.front())) {
    items_.take();
  }
}

/// The last item that has a pixel.
std::optional<PixelRectangle> WorkSource::give() {
  std::optional<PixelRectangle> item = items_.give();
  while (item && !is_wanted(*item)) {
    item = items_.give();
  }
  return item;
}

std::uint32_t WorkSource::next_pixel() {
  open_next();
  return scan_.next(image_width_);
}

core::SampleStep WorkSource::next_step() {
  open_next();
  return is_masked() ? steps_[scan_.place()] : core::SampleStep::first();
}

PixelRectangle WorkSource::take_background(const core::BackgroundTiles& background, std::uint32_t height_max) {
  PixelRectangle taken;
  if (!scan_.empty() || is_masked() || share_.step_x != 1 || share_.step_y != 1) {
    return taken;
  }
  while (const std::optional<PixelRectangle> item = items_.front()) {
    const bool goes_on = taken.width == 0 || (item->y == taken.y && item->x == taken.x + taken.width);
    if (!goes_on || item->height > height_max || !background.covers(item->x, item->y, item->width, item->height)) {
      break;
    }
    const std::uint32_t width = taken.width + item->width;
    taken = taken.width == 0 ? *item : taken;
    taken.width = width;
    items_.take();
  }
  return taken;
}

void WorkSource::ask() {
  core::expect(!has_pixel(), "only a node without pixels asks for some");
  if (asking_ || no_more_) {
    return;
  }
  asking_ = true;
  ++counters_.items_asked;
  send(last_donor_, {self_, worker_count_ - 1, pass_});
}

void WorkSource::send(std::uint32_t node, const WorkRequest& request) {
  node_->grant(nodes::NodeId{node}, ring_channel);  // the requester's slot on the ring: one request a node
  node_->send_reserved(nodes::NodeId{node}, ring_channel, number_of(Kind::work_request), request);
}

void WorkSource::answer(const WorkRequest& request) {
  core::expect(request.requester != self_ && request.visits_left > 0, "a work request asks each other node once");
  if (const auto item = give()) {
    ++counters_.items_given;
    reply(request.requester, *item);
  } else if (keeps(request)) {
    kept_[kept_count_++] = request;
  } else {
    pass_on(request);
  }
}

/// Whether this node's knowledge of others belongs to the request's pass.
bool WorkSource::knows_of(const WorkRequest& request) const { return passes_over_idle_ && request.pass == pass_; }

bool WorkSource::keeps(const WorkRequest& request) const {
  return asking_ && knows_of(request) && kept_count_ < kept_.size() && rank_of(request.requester) < rank_of(self_);
}

/// Called when this node has its answer.
void WorkSource::pass_on_kept() {
  for (const WorkRequest& request : kept_.first(std::exchange(kept_count_, 0))) {
    pass_on(request);
  }
}

/// Along the ring.
std::uint32_t WorkSource::steps_to(std::uint32_t node) const { return (node + worker_count_ - self_) % worker_count_; }

/// Steps to the first node that may have an item, as far as this node knows; it may be the requester. Once round the ring if none
/// has.
std::uint32_t WorkSource::steps_for(const WorkRequest& request) const {
  if (!knows_of(request)) {
    return 1;
  }
  return no_more_ ? worker_count_ : steps_to(last_donor_);
}

/// Passes on to the first node on the ring that may have an item, or back if there is none. The requester has none.
void WorkSource::pass_on(const WorkRequest& request) {
  const std::uint32_t to_requester = steps_to(request.requester);
  std::uint32_t steps = steps_for(request);
  steps += steps == to_requester ? 1 : 0;
  const std::uint32_t visits = steps - (to_requester < steps ? 1 : 0);  // nodes ahead, the last of which is to be asked
  nodes_passed_over_ += std::min(visits, request.visits_left) - 1;
  if (visits < request.visits_left) {
    send((self_ + steps) % worker_count_, {request.requester, request.visits_left - visits, request.pass});
  } else {
    reply(request.requester, {});
  }
}

void WorkSource::reply(std::uint32_t requester, const PixelRectangle& item) {
  node_->grant(nodes::NodeId{requester}, control_channel);  // the slot that the request has reserved
  const WorkReply work{SentItem(item), self_};
  if (is_masked()) {
    node_->send_reserved(nodes::NodeId{requester}, control_channel, number_of(Kind::work_reply),
                         MaskedWorkReply{work, steps_of(item)});
  } else {
    node_->send_reserved(nodes::NodeId{requester}, control_channel, number_of(Kind::work_reply), work);
  }
}

void WorkSource::take_reply(const nodes::Packet& packet) {
  core::expect(asking_ && !has_pixel(), "a work reply answers the one request under way");
  const auto masked = is_masked() ? packet.as<MaskedWorkReply>() : MaskedWorkReply{packet.as<WorkReply>(), {}};
  const WorkReply& reply = masked.reply;
  asking_ = false;
  const PixelRectangle item = reply.item.rectangle();
  no_more_ = item.pixel_count() == 0;
  if (!no_more_) {
    ++counters_.items_taken;
    last_donor_ = reply.donor;
    open(item, masked.steps);
  }
  pass_on_kept();
}

std::string WorkSource::describe() const {
  return std::to_string(items_.count()) + " work items left" + (asking_ ? ", asking for work" : no_more_ ? ", no more work" : "");
}

}  // namespace dmpc::svm
