// The extensions that a glTF document uses, and their effect on its picture.
#pragma once

#include <string>
#include <vector>

#include "apps/foreign/gltf/document.h"

namespace dmpc::apps::gltf {

/// Throws core::InputError that names all unsupported extensions that the document requires.
void check_required(const Document& document);

/// Appends a sentence, with a count, for each feature of an extension, or of glTF itself, that is not shown exactly (for others
/// see apps/foreign/gltf/places.h), and one that names all unknown extensions.
void note_extensions(const Document& document, std::vector<std::string>& notes);

}  // namespace dmpc::apps::gltf
