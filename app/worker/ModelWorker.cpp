// patina-model-worker
#include "app/worker/WorkerMain.h"
#include "core/codec/model/ModelCodec.h"

#include <nlohmann/json.hpp>

using namespace patina;

int main() {
    return worker::workerMain(
        {{"importModel",
          [](const nlohmann::json& header, const protocol::Request&, FileDescriptor& payload) {
              return codec::importModel(header, payload.get());
          }},
         {"listGltfKeys",
          [](const nlohmann::json& header, const protocol::Request&, FileDescriptor& payload) {
              return codec::listGltfKeys(header, payload.get());
          }}},
        [] {});
}
