// SPDX-License-Identifier: MIT
#include "codes.h"

#include <memory>

#include "core/pack/format_names.h"
#include "peers.h"
#include "tspace/pack.h"

namespace tspace::bench {

using test::FrameList;

std::vector<Code> allCodes() {
    constexpr const char* kDecoders[] = {"Frame32",    "Frame48",     "Frame64",    "Oct32",      "Qtangent64",
                                         "Snorm8Pair", "Snorm16Pair", "GltfSnorm8", "GltfSnorm16"};
    std::vector<Code> codes;
    for (std::uint32_t f = 0; f < std::size(kDecoders); ++f) {
        const FrameFormat format{f};
        const std::size_t bytes = frameBytes(format);
        const auto words = std::make_shared<std::vector<std::byte>>(bytes * kBatch);
        codes.push_back({test::kFormatNames[f], std::string("tspace_decode") + kDecoders[f], bytes,
                         [=](const FrameList& in) { (void)packFrames(in.normals, in.tangents, format, *words); },
                         [=](FrameList& out) { (void)unpackFrames(*words, format, out.normals, out.tangents); }});
    }
    for (const Peer& peer : peers()) {
        const auto words = std::make_shared<std::vector<PeerWords>>(kBatch);
        codes.push_back({peer.name, peer.function, peer.bytes,
                         [=](const FrameList& in) {
                             for (std::size_t i = 0; i < kBatch; ++i)
                                 (*words)[i] = peer.encode({in.normals[i], in.tangents[i]});
                         },
                         [=](FrameList& out) {
                             for (std::size_t i = 0; i < kBatch; ++i) {
                                 const PeerFrame f = peer.decode((*words)[i]);
                                 out.normals[i] = f.normal;
                                 out.tangents[i] = f.tangent;
                             }
                         }});
    }
    return codes;
}

}  // namespace tspace::bench
