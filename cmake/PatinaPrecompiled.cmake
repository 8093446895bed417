# Precompiled headers: the standard library, GLM, fmt and what Qt's widgets or GoogleTest need, parsed
# once for many sources instead of once for each. Nothing of Patina's own is in them, so that a change
# of ours never renews them, and sources still include what they use (PATINA_PRECOMPILED_HEADERS=OFF
# builds without them). nlohmann-json, CLI11 and spdlog are not: few sources see them.
option(PATINA_PRECOMPILED_HEADERS "Parse the headers of libraries once for many sources" ON)

set(PATINA_COMMON_HEADERS
  <algorithm> <array> <chrono> <cmath> <cstdint> <cstring> <filesystem> <functional> <limits> <map>
  <memory> <numbers> <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>
  <fmt/format.h> <glm/glm.hpp> <glm/gtc/matrix_transform.hpp> <glm/gtc/quaternion.hpp>)
set(PATINA_WIDGET_HEADERS
  <QAction> <QApplication> <QComboBox> <QElapsedTimer> <QEvent> <QHBoxLayout> <QImage> <QLabel> <QMenu>
  <QMouseEvent> <QPainter> <QPushButton> <QTimer> <QToolButton> <QVBoxLayout> <QWidget>)
set(PATINA_TEST_HEADERS <gmock/gmock.h> <gtest/gtest.h>)

# patina_precompile(TARGET HEADER…): TARGET parses these once, and may lend the result to others.
function(patina_precompile target)
  if(PATINA_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE ${ARGN})
    # ccache hashes a precompiled header only where it can see which one was used.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  endif()
endfunction()

# patina_reuse_precompiled(TARGET FROM): TARGET uses what FROM parsed. Both must be compiled with the same
# flags (optimization and position independence included), and TARGET with all definitions of FROM: GCC
# refuses otherwise.
function(patina_reuse_precompiled target from)
  if(PATINA_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM ${from})
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  endif()
endfunction()
