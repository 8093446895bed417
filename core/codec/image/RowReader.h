// Pictures of one part that come row by row from the top: PNG and JPEG.
#pragma once

#include "core/codec/image/HandOn.h"
#include "core/codec/image/PictureReader.h"

namespace patina::codec {

class RowReader : public PictureReader {
  public:
    const PictureSpec* part(int index) final { return index == 0 ? &m_spec : nullptr; }
    void read(int index, Channels channels, std::span<std::byte> pixels) final;
    // Integers are not reduced while they are read.
    void readRows(int, Channels, int, int, std::span<float>) final { throw HandOn{"reduced"}; }

  protected:
    // The next row, all channels. Throws HandOn.
    virtual void nextRow(std::byte* row) = 0;

    PictureSpec m_spec;
};

} // namespace patina::codec
