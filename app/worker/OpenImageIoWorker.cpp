// patina-openimageio-worker
#include "app/worker/WorkerMain.h"
#include "core/codec/openimageio/OpenImageIoCodec.h"

#include <nlohmann/json.hpp>

using namespace patina;

int main() {
    using Header = nlohmann::json;
    using Request = protocol::Request;
    return worker::workerMain(
        {{"decodeImage",
          [](const Header& header, const Request&, FileDescriptor& payload) {
              return codec::decodeWithOpenImageIo(header, payload.get());
          }},
         {"encodeImage",
          [](const Header& header, const Request& request, FileDescriptor& payload) {
              const MemoryFile pixels = worker::openPayload(request, payload);
              return codec::encodeWithOpenImageIo(header, pixels.bytes());
          }},
         {"displayMenu", [](const Header& header, const Request&,
                            FileDescriptor&) { return codec::displayMenu(header); }},
         {"displayTransform", [](const Header& header, const Request&,
                                 FileDescriptor&) { return codec::displayTransform(header); }}},
        codec::prepareOpenImageIo);
}
