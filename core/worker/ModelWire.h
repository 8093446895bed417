// A model on its way from the worker's child to the client: JSON for what is small, arrays one
// after another for what is large. The reader believes nothing: every count is checked against the
// bytes that are there.
#pragma once

#include "core/base/Result.h"
#include "core/mesh/ImportedModel.h"

#include <cstddef>
#include <span>
#include <string>

namespace patina {

// The header's JSON; `payloadSize` receives the bytes writeModelPayload() will need.
std::string writeModelHeader(const ImportedModel& model, std::size_t& payloadSize);
void writeModelPayload(const ImportedModel& model, std::span<std::byte> payload);

// ImportedTexture::file is still the path as the model spells it. Indices of triangles are not
// checked here (sanitizeMesh does); all other indices and counts are.
Result<ImportedModel> readModel(const std::string& header, std::span<const std::byte> payload);

} // namespace patina
