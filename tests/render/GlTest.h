// A fixture with a headless context; every test must end without an OpenGL error.
#pragma once

#include "render/gl/Context.h"

#include <gtest/gtest.h>
#include <memory>

namespace patina::gl {

unsigned takeGlError(); // glGetError

class GlTest : public testing::Test {
  protected:
    void SetUp() override {
        auto made = Context::createHeadless();
        ASSERT_TRUE(made.ok()) << made.error().text();
        m_context = std::move(*made);
    }
    void TearDown() override {
        if (m_context) {
            EXPECT_EQ(takeGlError(), 0u) << "the test left an OpenGL error";
        }
    }
    Context& context() { return *m_context; }

  private:
    std::unique_ptr<Context> m_context;
};

} // namespace patina::gl
