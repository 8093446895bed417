#include "tests/render/GlTest.h"

#include <epoxy/gl.h>

namespace patina::gl {

unsigned takeGlError() {
    return glGetError();
}

} // namespace patina::gl
