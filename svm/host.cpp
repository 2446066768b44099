#include "svm/host.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/base/expect.h"
#include "core/base/units.h"

namespace dmpc::svm {
namespace {

std::size_t words_for(std::uint32_t pixel_count) { return core::ceil_divide<std::size_t>(pixel_count, 64); }

}  // namespace

HostProgram::HostProgram(nodes::Node& node, const HostShape& shape, core::Film& film, nodes::Progress progress,
                         const core::Continuation& continuation)
    : node_(&node),
      film_(&film),
      progress_(std::move(progress)),
      continuation_(continuation),
      refinement_(shape.refinement, shape.first_samples, film.width(), film.height(), shape.detail),
      arrived_(node.memory().allocate<std::uint64_t>(nodes::Category::film_tiles, words_for(shape.pixel_count()))),
      pixels_sent_(shape.refinement.is_wanted() ? shape.node_count : 0),
      node_count_(shape.node_count),
      worker_count_(shape.worker_count),
      width_(shape.width),
      height_(shape.height) {
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    node.grant(nodes::NodeId{i}, control_channel, 1);  // for Stop; an acknowledgement's place is reserved by its film packet
  }
  if (const core::PartialPicture* const start = shape.start) {
    refinement_.resume(*start);
    const std::span<const std::uint64_t> done = start->done.words();
    std::copy(done.begin(), done.end(), arrived_.begin());
    pixels_done_ = pixels_found_done_ = start->done.count();
  }
}

void HostProgram::add_needs(nodes::MemoryPlan& plan, const HostShape& shape) {
  plan[nodes::Category::film_tiles] += nodes::LocalMemory::bytes_for<std::uint64_t>(words_for(shape.pixel_count()));
}

void HostProgram::receive(const nodes::Packet& packet) {
  switch (Kind{packet.kind}) {
    case Kind::film_sums:
      return take_film(packet);
    case Kind::done:
      return take_done(packet.as<Done>());
    case Kind::mask_acknowledgement:
      return send_mask(nodes::index_of(packet.source));
    default:
      core::expect(false, "the host receives film and word that nodes are done");
  }
}

void HostProgram::take_film(const nodes::Packet& packet) {
  core::expect(packet.payload.size() >= sizeof(FilmHeader), "a film packet has a header");
  FilmHeader header;
  std::memcpy(&header, packet.payload.data(), sizeof(header));
  core::expect(packet.payload.size() == sizeof(header) + header.count * sizeof(FilmEntry), "a film packet is as long as it says");
  for (std::uint32_t i = 0; i < header.count; ++i) {
    FilmEntry entry;
    std::memcpy(&entry, packet.payload.data() + sizeof(header) + i * sizeof(entry), sizeof(entry));
    take_pixel(entry);
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

void HostProgram::take_pixel(const FilmEntry& entry) {
  core::expect(entry.pixel < film_->pixels().size() && refinement_.pass().has(entry.pixel), "a finished pixel is of the pass");
  std::uint64_t& word = arrived_[entry.pixel / 64];
  const std::uint64_t bit = std::uint64_t{1} << (entry.pixel % 64);
  core::expect((word & bit) == 0, "each pixel arrives once");
  word |= bit;
  ++pixels_done_;
  deposits_saturated_ += film_->deposit(entry.pixel, entry.sums) ? 1 : 0;
  if (continuation_.watch) {
    continuation_.watch(*film_, refinement_, entry.pixel);
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

/// The film is complete: begins with the next pass, or stops all.
void HostProgram::end_pass() {
  if (!refinement_.next_pass(*film_)) {
    return stop();
  }
  std::fill(arrived_.begin(), arrived_.end(), 0);
  std::fill(pixels_sent_.begin(), pixels_sent_.end(), 0);
  pixels_of_old_passes_ += std::exchange(pixels_done_, 0) - std::exchange(pixels_found_done_, 0);
  pixels_announced_ = nodes_done_ = nodes_masked_ = 0;
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    send_mask(i);
  }
}

/// The next part of a node's mask; when all nodes have theirs, the word to begin.
void HostProgram::send_mask(std::uint32_t index) {
  const PixelRectangle submap = submap_of({0, 0, width_, height_}, index, worker_count_);
  MaskPart part{pixels_sent_[index]};
  if (part.first_pixel >= submap.pixel_count()) {
    nodes_masked_ += 1;
    return nodes_masked_ == node_count_ ? begin_pass() : void();
  }
  const std::uint64_t count = std::min<std::uint64_t>(part.steps.size(), submap.pixel_count() - part.first_pixel);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t place = part.first_pixel + i;
    const std::uint64_t x = submap.x + place % submap.width, y = submap.y + place / submap.width;
    part.steps[i] = refinement_.pass().steps()[y * width_ + x];
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
