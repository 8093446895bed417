// Models: what the worker for models does.
#pragma once

#include "core/codec/Codec.h"

namespace patina::codec {

// Takes the request's header and the file's descriptor. Throws Refusal and std::bad_alloc.
Reply importModel(const nlohmann::json& request, int payloadFd);
// "keys": a row [key, KeyUse, why, count] for each row of gltfKeys().
Reply listGltfKeys(const nlohmann::json& request, int payloadFd);

} // namespace patina::codec
