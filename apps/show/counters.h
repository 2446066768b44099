// Names the counters of renders, in addition to those of any program (apps/frontend/show/counters.h).
#pragma once

#include <array>

#include "apps/frontend/show/counters.h"
#include "core/trace/operations.h"
#include "dataflow/program.h"
#include "dataflow/rays/gather.h"
#include "dataflow/units/movement.h"
#include "svm/pages/node_program.h"

namespace dmpc::apps {

// clang-format off
template <>
inline constexpr auto counters_of<svm::WorkCounters> = std::array{
    counter<&svm::WorkCounters::pixels_rendered>({"pixels", "over all passes", "pixels"}),
    counter<&svm::WorkCounters::items_asked>({"items_asked"}),
    counter<&svm::WorkCounters::items_taken>({"items_taken"}),
    counter<&svm::WorkCounters::items_given>({"items_given"}),
};

template <>
inline constexpr auto counters_of<svm::QuestionCounters> = std::array{
    counter<&svm::QuestionCounters::rays_asked>({"rays_asked", "what does a ray meet below a child", "rays asked about"}),
    counter<&svm::QuestionCounters::records_asked>(
        {"records_asked", "what is in a record, for shading or above base meshes", "records asked for"}),
    counter<&svm::QuestionCounters::rays_answered>({"rays_answered", "", "rays answered"}),
    counter<&svm::QuestionCounters::records_answered>({"records_answered", "", "records answered"}),
    counter<&svm::QuestionCounters::answers>({"answers", "packets received", "answers"}),
};

/// Events of rays on their way.
template <>
inline constexpr auto counters_of<dataflow::RayCounters> = std::array{
    counter<&dataflow::RayCounters::hits_sent_back>({"hits_sent_back", "to the node that found them"}),
    counter<&dataflow::RayCounters::tests_avoided>(
        {"tests_avoided", "primitives that rays had tested elsewhere (option tested_objects)"}),
};

template <>
inline constexpr auto counters_of<dataflow::Gather::Counters> = std::array{
    counter<&dataflow::Gather::Counters::packets>({"packets", "of rays"}),
    counter<&dataflow::Gather::Counters::packets_flushed>({"packets_flushed", "sent before they were full"}),
    counter<&dataflow::Gather::Counters::packets_queued>({"packets_queued", "sent after a wait for credit"}),
};

/// The part of these that was sent by way of the host.
inline constexpr std::array overflow_counters = {
    counter<&dataflow::Gather::Counters::rays_overflowed>({"rays"}),
    counter<&dataflow::Gather::Counters::packets_overflowed>({"packets"}),
};

/// The part of these that waited.
inline constexpr std::array queue_counters = {
    counter<&dataflow::Gather::Counters::queue_high_water>(
        {"queue_max", "packets that waited to be sent on a node at once"}),
};

template <>
inline constexpr auto counters_of<dataflow::ProgramCounts> = std::array{
    counter<&dataflow::ProgramCounts::backlog_high_water>(
        {"backlog_max", "rays that waited to be traced on a node at once", "most rays waiting"}),
};

template <>
inline constexpr auto counters_of<dataflow::MovementCounters> = std::array{
    counter<&dataflow::MovementCounters::units>({"units", "answered for in the end"}),
    counter<&dataflow::MovementCounters::units_given>({"units_given"}),
    counter<&dataflow::MovementCounters::units_taken>({"units_taken"}),
    counter<&dataflow::MovementCounters::asks>({"asks", "for a unit"}),
    counter<&dataflow::MovementCounters::refusals>({"refusals", "in answer to them"}),
    counter<&dataflow::MovementCounters::pages_sent>({"pages_sent", "with units"}),
    counter<&dataflow::MovementCounters::pages_installed>(
        {"pages_installed", "of those that came, as they had not been there"}),
    counter<&dataflow::MovementCounters::records_walked>(
        {"records_walked", "to find the pages of units that were asked for"}),
    counter<&dataflow::MovementCounters::primaries_given>({"primary_rays_given", "with units, before they started"}),
    counter<&dataflow::MovementCounters::primaries_taken>({"primary_rays_taken"}),
    counter<&dataflow::MovementCounters::rays_sent_on>(
        {"rays_sent_on", "that came for a unit which was another's by then"}),
};

/// Hits of rays.
inline constexpr std::array hit_counters = {
    counter<&core::Operations::primary_hits>({"primary"}),
    counter<&core::Operations::secondary_hits>({"secondary", "of reflected and refracted rays"}),
    counter<&core::Operations::shadow_blocked>({"shadow_blocked", "shadow rays that met something"}),
    counter<&core::Operations::total_internal_reflections>({"total_internal_reflections"}),
};

template <>
inline constexpr auto counters_of<core::Operations> = std::array{
    counter<&core::Operations::cell_steps>({"cell_steps"}),
    counter<&core::Operations::empty_cells>({"empty_cells", "that rays left together with others in one step"}),
    counter<&core::Operations::bvh_node_reads>({"bvh_node_reads"}),
    counter<&core::Operations::primitive_tests, 0>({"triangle_tests"}),
    counter<&core::Operations::primitive_tests, 1>({"sphere_tests"}),
    counter<&core::Operations::primitive_tests, 2>({"cone_tests"}),
    counter<&core::Operations::instance_entries>({"instance_entries", "rays that went into a base mesh"}),
    counter<&core::Operations::placed_triangles>(
        {"placed_triangles", "of base meshes, by walks (once for a bundle) and to be shaded"}),
    counter<&core::Operations::shadings>({"shadings", "", "shadings"}),
    counter<&core::Operations::normal_reads>({"normal_reads", "vertex normals of smooth triangles"}),
    counter<&core::Operations::texture_lookups>({"texture_lookups", "hits on textured triangles"}),
    counter<&core::Operations::tile_reads>({"tile_reads", "of their textures' tiles"}),
    counter<&core::Operations::bundles>({"bundles", "of rays that walked together"}),
    counter<&core::Operations::rays_in_bundles>({"rays_in_bundles"}),
    counter<&core::Operations::deposits_saturated>(
        {"deposits_saturated", "null where earlier samples came from a checkpoint", "", true}),
};
// clang-format on

}  // namespace dmpc::apps
