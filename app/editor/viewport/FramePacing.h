// Keeps the viewport fluid on a slow GPU: while the hand moves, frames are drawn at a reduced
// resolution chosen from the measured frame time; when it rests, first at full resolution, then
// once with anti-aliasing, in slices where that takes long. A fast GPU draws everything at full
// quality all the time.
#pragma once

namespace patina::editor {

class FramePacing {
  public:
    // Side length relative to the widget's: 1 … ¼.
    [[nodiscard]] float scale() const;
    [[nodiscard]] int samples() const; // MSAA: 1 or 4
    // Frames are anti-aliased by adding them up (FrameSettings::accumulate), not by MSAA.
    void setAccumulates(bool accumulates) { m_accumulates = accumulates; }
    // Nothing but their mean has depth of field: they are added up, in slices where they are slow.
    void setHasLens(bool hasLens) { m_hasLens = hasLens; }
    // They are added up however slow they are: for who needs the very picture that a fast machine
    // ends with, as tests do.
    void setAddsSlowFrames(bool adds) { m_addsSlowFrames = adds; }
    // At rest the frames are to be added up: of a picture all of them or none. One that took long,
    // as frames do that wait for the driver's compiler, decides of the next picture: the mean of
    // some is neither what is shown without them nor what any other machine ends with.
    [[nodiscard]] bool accumulating() const;
    [[nodiscard]] bool moving() const { return m_stage == Stage::Moving; }

    // Whether frames at rest are drawn in slices, between which input is handled.
    [[nodiscard]] bool slices() const;
    // Milliseconds that the next frame at rest is expected to take; below 0: unknown.
    [[nodiscard]] double expectedMs() const;

    // The first scale of a movement is estimated from the last frame at full resolution, so that
    // not even the first frame is slow.
    void beginMoving();
    // The hand rests: one step finer. Returns whether there is something new to draw; false when
    // the picture is as fine as it gets, or anti-aliasing would hold up the hand for too long.
    bool refine();
    // refine() has nothing to offer any more.
    [[nodiscard]] bool refined() const;
    // The picture has changed, but not by the hand: at rest it is refined anew, for an anti-aliased
    // frame may hold up whatever comes next.
    void pictureChanged();
    // Milliseconds of the last frame, GPU included.
    void frameTook(double milliseconds);

  private:
    void beginPicture();

    enum class Stage { Moving, FullResolution, Antialiased };
    Stage m_stage = Stage::FullResolution;
    bool m_accumulates = false;
    bool m_hasLens = false;
    bool m_addsSlowFrames = false;
    bool m_adds = true; // frames of the picture at rest
    int m_level = 0;    // index into the scales
    int m_fastFrames = 0;
    double m_fullMs = -1.0;        // last full-resolution frame without anti-aliasing; -1: none yet
    double m_antialiasedMs = -1.0; // last one with; -1: none yet
    double m_expectedMs = -1.0;    // of one without, by the last frame of any size; -1: none yet
};

} // namespace patina::editor
