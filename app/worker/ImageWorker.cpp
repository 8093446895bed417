// patina-image-worker
#include "app/worker/WorkerMain.h"
#include "core/codec/image/ImageCodec.h"

#include <nlohmann/json.hpp>

using namespace patina;

namespace {

codec::Reply encode(const nlohmann::json& header, const protocol::Request& request,
                    FileDescriptor& payload) {
    const auto bytes = MemoryFile::open(std::move(payload), request.payloadSize);
    if (!bytes)
        throw codec::Refusal("the image cannot be encoded", "payload");
    return codec::encodeImage(header, bytes->bytes());
}

} // namespace

int main() {
    using Header = nlohmann::json;
    using Request = protocol::Request;
    return worker::workerMain(
        {{"decodeImage",
          [](const Header& header, const Request&, FileDescriptor& payload) {
              return codec::decodeImage(header, payload.get());
          }},
         {"encodeImage", encode},
         {"displayMenu", [](const Header& header, const Request&,
                            FileDescriptor&) { return codec::displayMenu(header); }},
         {"displayTransform", [](const Header& header, const Request&,
                                 FileDescriptor&) { return codec::displayTransform(header); }}},
        codec::prepareImageCodec);
}
