#include "svm/host.h"

#include <algorithm>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::svm {

HostProgram::HostProgram(nodes::Node& node, const Plan& plan, core::Film& film, nodes::Progress progress,
                         const core::Continuation& continuation)
    : Host(node, film, plan.request.refinement, plan.request.first_samples, std::move(progress), continuation,
           plan.request.detail),
      plan_(plan),
      pixels_sent_(plan.request.refinement.is_wanted() ? plan.node_count() : 0),
      node_count_(plan.node_count()),
      assigned_side_(plan.request.is_assigned() ? plan.work_item_side : 0),
      is_masked_(plan.request.is_masked()),
      items_({}, 0),
      pixels_found_done_(pixels_with_light()) {
  grant_stops();
  if (are_at_host(plan.request.pages.homes)) {
    home_.emplace(HomePages(node, plan.pages(), plan.request.database), PageServer(node, plan.pages()));
  }
  start_dealing();
}

nodes::MemoryPlan HostProgram::layout(const Plan& plan) {
  nodes::MemoryPlan memory = own_layout(std::size_t{plan.request.width} * plan.request.height);
  if (are_at_host(plan.request.pages.homes)) {
    memory += HomePages::layout(plan.pages(), plan.node_count()) + PageServer::layout(plan.pages(), plan.node_count());
  }
  return memory;
}

void HostProgram::begin_frame(const core::FineDetail* detail) {
  Host::begin_frame(detail);
  grant_stops();
  std::fill(pixels_sent_.begin(), pixels_sent_.end(), 0);
  served_before_ = home_ ? home_->server.served() : 0;
  items_given_ = pixels_announced_ = pixels_of_old_passes_ = 0;
  nodes_masked_ = pixels_found_done_ = nodes_done_ = 0;
  stopped_ = false;
  start_dealing();
}

/// A film packet reserves the slot of its acknowledgement.
void HostProgram::grant_stops() {
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    node_->grant(nodes::NodeId{i}, control_channel, 1);
  }
}

void HostProgram::receive(const nodes::Packet& packet) {
  switch (Kind{packet.kind}) {
    case Kind::film_sums:
      return take_film(packet);
    case Kind::page_request:
    case Kind::passed_request:
      return serve(packet);
    case Kind::work_request:
      return assign(packet.as<WorkRequest>());
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
  const auto header = packet.front<FilmHeader>();
  core::expect(packet.payload.size() == film_packet_bytes(header.count, plan_.film_planes),
               "a film packet is as long as it says");
  for (std::uint32_t i = 0; i < header.count; ++i) {
    const FilmEntry entry = film_entry_in(packet.payload, i, plan_.film_planes);
    core::expect(take_light(entry.pixel, entry.more, entry.sums) == entry.more + 1, "each pixel arrives once");
  }
  node_->grant(packet.source, control_channel);
  node_->send_reserved(packet.source, control_channel, number_of(Kind::film_acknowledgement), FilmAcknowledgement{header.count});
  report_progress(pixels_with_light());
  if (is_due()) {
    keep_interrupted();
  }
}

void HostProgram::keep_interrupted() const {
  if (!stopped_ && may_be_kept()) {
    keep(with_light());
  }
}

void HostProgram::take_done(const Done& done) {
  ++nodes_done_;
  pixels_announced_ += done.pixels_rendered;
  if (nodes_done_ == node_count_) {
    const std::uint32_t pixels = refinement().pixel_count();
    core::expect(pixels_announced_ + pixels_found_done_ == pixels && pixels_with_light() == pixels,
                 "every pixel is rendered and has arrived");
    end_pass();
  }
}

PixelRectangle HostProgram::share_of(std::uint32_t index) const {
  return svm::share_of(image(), index, assigned_side_ > 0 ? 0 : plan_.worker_count, plan_.request.pages.pixel_shares);
}

void HostProgram::start_dealing() {
  if (assigned_side_ > 0) {
    items_ = WorkItems(image(), assigned_side_);
  }
}

/// The samples of an item's pixels: none has arrived for an assigned item, except those that an earlier run had rendered.
ItemSteps HostProgram::steps_of(const PixelRectangle& item) const {
  ItemSteps steps;
  for (std::uint32_t i = 0; i < item.pixel_count() && is_masked_; ++i) {
    const std::uint32_t pixel = item.pixel_at(i, plan_.request.width);
    steps[i] = has_light(pixel) ? core::SampleStep() : refinement().pass().steps()[pixel];
  }
  return steps;
}

/// The next item that has a pixel.
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

/// An empty item means that all are assigned.
void HostProgram::assign(const WorkRequest& request) {
  core::expect(assigned_side_ > 0, "the host is asked for work where it assigns it");
  const std::optional<PixelRectangle> item = next_item();
  items_given_ += item ? 1 : 0;
  const nodes::NodeId requester{request.requester};
  const WorkReply reply{SentItem(item.value_or(PixelRectangle{})), node_count_};
  node_->grant(requester, control_channel);  // the slot that the request has reserved
  if (is_masked_) {
    node_->send_reserved(requester, control_channel, number_of(Kind::work_reply),
                         MaskedWorkReply{reply, steps_of(reply.item.rectangle())});
  } else {
    node_->send_reserved(requester, control_channel, number_of(Kind::work_reply), reply);
  }
}

/// The film is complete: begins the next pass, or stops all nodes.
void HostProgram::end_pass() {
  const std::uint64_t done = pixels_done();
  if (!next_pass()) {
    return stop();
  }
  std::fill(pixels_sent_.begin(), pixels_sent_.end(), 0);
  pixels_of_old_passes_ = done;
  pixels_announced_ = nodes_done_ = nodes_masked_ = pixels_found_done_ = 0;
  start_dealing();
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    send_mask(i);
  }
}

/// Sends the next part of a node's mask; when all nodes have theirs, the message to begin.
void HostProgram::send_mask(std::uint32_t index) {
  const PixelRectangle share = share_of(index);
  MaskPart part{pixels_sent_[index]};
  if (part.first_pixel >= share.pixel_count()) {
    nodes_masked_ += 1;
    return nodes_masked_ == node_count_ ? begin_pass() : void();
  }
  const std::uint64_t count = std::min<std::uint64_t>(part.steps.size(), share.pixel_count() - part.first_pixel);
  for (std::uint64_t i = 0; i < count; ++i) {
    part.steps[i] = refinement().pass().steps()[share.pixel_at(part.first_pixel + i, plan_.request.width)];
  }
  pixels_sent_[index] += static_cast<std::uint32_t>(part.steps.size());
  node_->grant(nodes::NodeId{index}, bulk_channel);  // one part is in flight to each node
  node_->send_reserved(nodes::NodeId{index}, bulk_channel, number_of(Kind::mask_part), part);
}

void HostProgram::begin_pass() {
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    node_->grant(nodes::NodeId{i}, control_channel);  // its node is done, so nothing else of the host's is in flight
    node_->send_reserved(nodes::NodeId{i}, control_channel, number_of(Kind::begin_pass), BeginPass{});
  }
}

void HostProgram::stop() {
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    node_->send_reserved(nodes::NodeId{i}, control_channel, number_of(Kind::stop),
                         Stop{plan_.request.width * plan_.request.height});
  }
  stopped_ = true;
}

std::string HostProgram::describe() const {
  return std::to_string(pixels_with_light()) + " of " + std::to_string(refinement().pixel_count()) + " pixels of pass " +
         std::to_string(refinement().result().passes) + " arrived, " + std::to_string(nodes_done_) + " of " +
         std::to_string(node_count_) + " nodes done";
}

}  // namespace dmpc::svm
