#include "svm/host.h"

#include <cstring>
#include <utility>

#include "core/expect.h"
#include "core/units.h"

namespace dmpc::svm {
namespace {

std::size_t words_for(std::uint32_t pixel_count) { return core::ceil_divide<std::size_t>(pixel_count, 64); }

}  // namespace

HostProgram::HostProgram(nodes::Node& node, const Plan& plan, core::Film& film, Progress progress)
    : node_(&node),
      film_(&film),
      progress_(std::move(progress)),
      arrived_(node.memory().allocate<std::uint64_t>(nodes::Category::film_tiles,
                                                     words_for(plan.request.width * plan.request.height))),
      node_count_(plan.request.node_count),
      pixels_total_(plan.request.width * plan.request.height) {
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    node.grant(nodes::NodeId{i}, control_channel, 1);  // for Stop; an acknowledgement's place is reserved by its film packet
  }
}

void HostProgram::add_needs(nodes::MemoryPlan& plan, std::uint32_t pixel_count) {
  plan[nodes::Category::film_tiles] += nodes::LocalMemory::bytes_for<std::uint64_t>(words_for(pixel_count));
}

void HostProgram::receive(const nodes::Packet& packet) {
  switch (Kind{packet.kind}) {
    case Kind::film_sums:
      return take_film(packet);
    case Kind::done:
      return take_done(packet.as<Done>());
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
    progress_(pixels_done_, pixels_total_);
  }
}

void HostProgram::take_pixel(const FilmEntry& entry) {
  core::expect(entry.pixel < pixels_total_, "a finished pixel lies in the picture");
  std::uint64_t& word = arrived_[entry.pixel / 64];
  const std::uint64_t bit = std::uint64_t{1} << (entry.pixel % 64);
  core::expect((word & bit) == 0, "each pixel arrives once");
  word |= bit;
  ++pixels_done_;
  deposits_saturated_ += film_->deposit(entry.pixel, entry.sums) ? 1 : 0;
}

void HostProgram::take_done(const Done& done) {
  ++nodes_done_;
  pixels_announced_ += done.pixels_rendered;
  if (nodes_done_ == node_count_) {
    core::expect(pixels_announced_ == pixels_total_ && pixels_done_ == pixels_total_, "every pixel is rendered and has arrived");
    for (std::uint32_t i = 0; i < node_count_; ++i) {
      node_->send_reserved(nodes::NodeId{i}, control_channel, number_of(Kind::stop), Stop{pixels_total_});
    }
    stopped_ = true;
  }
}

std::string HostProgram::describe() const {
  return std::to_string(pixels_done_) + " of " + std::to_string(pixels_total_) + " pixels arrived, " +
         std::to_string(nodes_done_) + " of " + std::to_string(node_count_) + " nodes done";
}

}  // namespace dmpc::svm
