// What nodes of strategy forest ask each other, and answer: values, without pointers. A packet has as many as fill it.
//
//   kind                   from -> to          channel   size   its place in the target's mailbox is reserved by
//   questions              node -> owner       request   any    the sender's request credits for that owner
//   answers                owner -> node       bulk      any    the questions
//
// They stand in place of page requests and replies (svm/pages/packets.h), which has their numbers. They are small or bulk, as it
// comes: their credits reserve places of both.
#pragma once

#include <cstdint>

namespace dmpc::svm {

/// What a question asks for: what a ray meets below a child, outside of kept meshes or in one, or a record.
enum class QuestionKind : std::uint8_t { below, block, normals, tile, brick, below_in_mesh };

/// Whether it is about a ray.
constexpr bool is_about_ray(QuestionKind kind) { return kind == QuestionKind::below || kind == QuestionKind::below_in_mesh; }

/// Stands before a core::Below, in a mesh with a core::ToldPlace behind, or, of a record, its core::Address.
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

}  // namespace dmpc::svm
