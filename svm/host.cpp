#include "svm/host.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/picture/memory_use.h"

namespace dmpc::svm {
namespace {

/// A bit a pixel.
nodes::Room<std::uint64_t> own_layout(const HostShape& shape) {
  return {core::MemoryUse::film_tiles, core::ceil_divide<std::size_t>(shape.pixel_count(), 64)};
}

}  // namespace

HostProgram::HostProgram(nodes::Node& node, const HostShape& shape, core::Film& film, nodes::Progress progress,
                         const core::Continuation& continuation)
    : node_(&node),
      film_(&film),
      progress_(std::move(progress)),
      continuation_(continuation),
      wanted_(shape.refinement),
      first_samples_(shape.first_samples),
      refinement_(wanted_, first_samples_, film.width(), film.height(), shape.detail, film.scale()),
      arrived_(own_layout(shape).in(node.memory())),
      pixels_sent_(shape.refinement.is_wanted() ? shape.node_count : 0),
      node_count_(shape.node_count),
      worker_count_(shape.worker_count),
      width_(shape.width),
      height_(shape.height),
      planes_(shape.planes),
      dealt_side_(shape.dealt_side),
      shares_(shape.shares),
      is_masked_(shape.is_masked),
      items_({}, 0) {
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    node.grant(nodes::NodeId{i}, control_channel, 1);  // for Stop; an acknowledgement's place is reserved by its film packet
  }
  if (const core::PartialPicture* const start = shape.start) {
    refinement_.resume(*start);
    const std::span<const std::uint64_t> done = start->done.words();
    std::copy(done.begin(), done.end(), arrived_.begin());
    pixels_done_ = pixels_found_done_ = start->done.count();
  }
  if (shape.pages) {
    home_.emplace(HomePages(node, *shape.pages, shape.database), PageServer(node, *shape.pages));
  }
  start_dealing();
}

void HostProgram::begin_frame(const core::FineDetail* detail) {
  core::expect(stopped_, "a frame begins when the one before has ended");
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    node_->grant(nodes::NodeId{i}, control_channel, 1);  // for Stop
  }
  refinement_ = core::Refinement(wanted_, first_samples_, film_->width(), film_->height(), detail, film_->scale());
  std::fill(arrived_.begin(), arrived_.end(), 0);
  std::fill(pixels_sent_.begin(), pixels_sent_.end(), 0);
  served_before_ = home_ ? home_->server.served() : 0;
  items_given_ = pixels_announced_ = pixels_of_old_passes_ = deposits_saturated_ = 0;
  nodes_masked_ = pixels_done_ = pixels_found_done_ = nodes_done_ = 0;
  stopped_ = false;
  start_dealing();
}

nodes::MemoryPlan HostProgram::layout(const HostShape& shape) {
  nodes::MemoryPlan plan = own_layout(shape);
  if (shape.pages) {
    plan += HomePages::layout(*shape.pages, shape.node_count) + PageServer::layout(*shape.pages, shape.node_count);
  }
  return plan;
}

void HostProgram::receive(const nodes::Packet& packet) {
  switch (Kind{packet.kind}) {
    case Kind::film_sums:
      return take_film(packet);
    case Kind::page_request:
    case Kind::passed_request:
      return serve(packet);
    case Kind::work_request:
      return deal(packet.as<WorkRequest>());
    case Kind::done:
      return take_done(packet.as<Done>());
    case Kind::mask_acknowledgement:
      return send_mask(nodes::index_of(packet.source));
    default:
      core::expect(false, "the host receives film, requests for pages or work, and word that nodes are done");
  }
}

void HostProgram::serve(const nodes::Packet& packet) {
  core::expect(home_.has_value(), "the host is asked for pages where they are at home there");
  const PassedRequest request = request_in(packet);
  const std::byte* const bytes = home_->pages.find(request.page);
  core::expect(bytes != nullptr, "the host is asked for pages that there are");
  home_->server.reply(request, bytes);
}

void HostProgram::take_film(const nodes::Packet& packet) {
  core::expect(packet.payload.size() >= sizeof(FilmHeader), "a film packet has a header");
  FilmHeader header;
  std::memcpy(&header, packet.payload.data(), sizeof(header));
  core::expect(packet.payload.size() == film_packet_bytes(header.count, planes_), "a film packet is as long as it says");
  for (std::uint32_t i = 0; i < header.count; ++i) {
    const FilmEntry entry = film_entry_in(packet.payload, i, planes_);
    core::expect(entry.pixel < film_->pixel_count() && entry.more < film_->pixel_count() - entry.pixel,
                 "finished pixels are of the picture");
    for (std::uint32_t pixel = entry.pixel; pixel <= entry.pixel + entry.more; ++pixel) {
      take_pixel(pixel, entry.sums);
    }
  }
  node_->grant(packet.source, control_channel);
  node_->send_reserved(packet.source, control_channel, number_of(Kind::film_acknowledgement), FilmAcknowledgement{header.count});
  if (progress_) {
    progress_(pixels_done_, refinement_.pixel_count());
  }
  if (continuation_.is_due && continuation_.is_due()) {
    keep();
  }
}

void HostProgram::keep() const {
  if (stopped_ || !continuation_.keep) {
    return;
  }
  core::PixelMask done(width_ * height_);
  std::copy(arrived_.begin(), arrived_.end(), done.words().begin());
  continuation_.keep(*film_, refinement_, done);
}

void HostProgram::take_pixel(std::uint32_t pixel, const core::PixelSums& sums) {
  core::expect(refinement_.pass().has(pixel), "a finished pixel is of the pass");
  core::expect(!has_arrived(pixel), "each pixel arrives once");
  arrived_[pixel / 64] |= std::uint64_t{1} << (pixel % 64);
  ++pixels_done_;
  deposits_saturated_ += film_->deposit(pixel, sums) ? 1 : 0;
  if (continuation_.watch) {
    continuation_.watch(*film_, refinement_, pixel);
  }
}

void HostProgram::take_done(const Done& done) {
  ++nodes_done_;
  pixels_announced_ += done.pixels_rendered;
  if (nodes_done_ == node_count_) {
    const std::uint32_t pixels = refinement_.pixel_count();
    core::expect(pixels_announced_ + pixels_found_done_ == pixels && pixels_done_ == pixels,
                 "every pixel is rendered and has arrived");
    end_pass();
  }
}

PixelRectangle HostProgram::share_of(std::uint32_t index) const {
  return svm::share_of(image(), index, dealt_side_ > 0 ? 0 : worker_count_, shares_);
}

void HostProgram::start_dealing() {
  if (dealt_side_ > 0) {
    items_ = WorkItems(image(), dealt_side_);
  }
}

/// Which samples an item's pixels have: an item that is dealt has none that has arrived, but those that another run had rendered.
ItemSteps HostProgram::steps_of(const PixelRectangle& item) const {
  ItemSteps steps;
  for (std::uint32_t i = 0; i < item.pixel_count() && is_masked_; ++i) {
    const std::uint32_t pixel = item.pixel_at(i, width_);
    steps[i] = has_arrived(pixel) ? core::SampleStep() : refinement_.pass().steps()[pixel];
  }
  return steps;
}

/// The next that has a pixel.
std::optional<PixelRectangle> HostProgram::next_item() {
  const auto is_none = [](const core::SampleStep& step) { return step.is_none(); };
  while (auto item = items_.take()) {
    const ItemSteps steps = steps_of(*item);
    if (!is_masked_ || !std::all_of(steps.begin(), steps.end(), is_none)) {
      return item;
    }
  }
  return std::nullopt;
}

/// An empty item says that all are dealt.
void HostProgram::deal(const WorkRequest& request) {
  core::expect(dealt_side_ > 0, "the host is asked for work where it deals it");
  const std::optional<PixelRectangle> item = next_item();
  items_given_ += item ? 1 : 0;
  const nodes::NodeId asker{request.asker};
  const WorkReply reply{SentItem(item.value_or(PixelRectangle{})), node_count_};
  node_->grant(asker, control_channel);  // the place that the request has reserved
  if (is_masked_) {
    node_->send_reserved(asker, control_channel, number_of(Kind::work_reply),
                         MaskedWorkReply{reply, steps_of(reply.item.rectangle())});
  } else {
    node_->send_reserved(asker, control_channel, number_of(Kind::work_reply), reply);
  }
}

/// The film is complete: begins with the next pass, or stops all.
void HostProgram::end_pass() {
  if (!refinement_.next_pass(*film_)) {
    return stop();
  }
  std::fill(arrived_.begin(), arrived_.end(), 0);
  std::fill(pixels_sent_.begin(), pixels_sent_.end(), 0);
  pixels_of_old_passes_ += std::exchange(pixels_done_, 0) - std::exchange(pixels_found_done_, 0);
  pixels_announced_ = nodes_done_ = nodes_masked_ = 0;
  start_dealing();
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    send_mask(i);
  }
}

/// The next part of a node's mask; when all nodes have theirs, the word to begin.
void HostProgram::send_mask(std::uint32_t index) {
  const PixelRectangle share = share_of(index);
  MaskPart part{pixels_sent_[index]};
  if (part.first_pixel >= share.pixel_count()) {
    nodes_masked_ += 1;
    return nodes_masked_ == node_count_ ? begin_pass() : void();
  }
  const std::uint64_t count = std::min<std::uint64_t>(part.steps.size(), share.pixel_count() - part.first_pixel);
  for (std::uint64_t i = 0; i < count; ++i) {
    part.steps[i] = refinement_.pass().steps()[share.pixel_at(part.first_pixel + i, width_)];
  }
  pixels_sent_[index] += static_cast<std::uint32_t>(part.steps.size());
  node_->grant(nodes::NodeId{index}, bulk_channel);  // one part is under way to each node
  node_->send_reserved(nodes::NodeId{index}, bulk_channel, number_of(Kind::mask_part), part);
}

void HostProgram::begin_pass() {
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    node_->grant(nodes::NodeId{i}, control_channel);  // its node is done, so that nothing else of the host's is under way
    node_->send_reserved(nodes::NodeId{i}, control_channel, number_of(Kind::begin_pass), BeginPass{});
  }
}

void HostProgram::stop() {
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    node_->send_reserved(nodes::NodeId{i}, control_channel, number_of(Kind::stop), Stop{width_ * height_});
  }
  stopped_ = true;
}

std::string HostProgram::describe() const {
  return std::to_string(pixels_done_) + " of " + std::to_string(refinement_.pixel_count()) + " pixels of pass " +
         std::to_string(refinement_.result().passes) + " arrived, " + std::to_string(nodes_done_) + " of " +
         std::to_string(node_count_) + " nodes done";
}

}  // namespace dmpc::svm
