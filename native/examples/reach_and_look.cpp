// A plain skeleton that reaches for a ball and looks at it: reach_and_look FILE.csv
// Each line of the file is a frame: the ball, elbow and hand, and the turns of spine and head as unit
// quaternions.
#include <cmath>
#include <fstream>
#include <motus/bones/chains/two_bone.hpp>
#include <motus/bones/look_at/gaze.hpp>

using namespace motus;

namespace {

std::ofstream& operator<<(std::ofstream& file, const glm::dvec3& place) {
    static_cast<std::ostream&>(file) << ',' << place.x << ',' << place.y << ',' << place.z;
    return file;
}

std::ofstream& operator<<(std::ofstream& file, const glm::dquat& turn) {
    static_cast<std::ostream&>(file) << ',' << turn.w << ',' << turn.x << ',' << turn.y << ',' << turn.z;
    return file;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 1;

    // The figure faces -Y; metres.
    bones::chains::TwoBone arm;
    arm.root = {0.2, 0.0, 1.4};  // the shoulder
    arm.pole = {0.4, 1.0, 1.0};  // the elbow points backwards
    arm.length1 = 0.32;
    arm.length2 = 0.28;
    arm.softness = 0.03;  // the arm slows before it is straight, so that the elbow never snaps

    const glm::dvec3 eyes{0.0, 0.0, 1.65}, forward{0.0, -1.0, 0.0}, up{0.0, 0.0, 1.0};
    const bones::look_at::GazeSettings gaze{.body_weight = 0.3, .head_weight = 0.9};
    const bones::look_at::GazeChart chart(forward, up, bones::look_at::level_for(gaze));

    std::ofstream file(argv[1]);
    file << "time,ball_x,ball_y,ball_z,elbow_x,elbow_y,elbow_z,hand_x,hand_y,hand_z,"
            "spine_w,spine_x,spine_y,spine_z,head_w,head_x,head_y,head_z\n";
    for (int frame = 0; frame <= 96; ++frame) {
        const double time = frame / 24.0;
        const glm::dvec3 ball{0.2 + 0.5 * std::sin(time), -0.55, 1.3 + 0.3 * std::cos(2.0 * time)};
        arm.target = ball;
        const bones::chains::TwoBoneSolution reach = bones::chains::solve_two_bone(arm);
        const glm::dvec3 to_ball =
            (ball - eyes) / std::hypot(ball.x - eyes.x, ball.y - eyes.y, ball.z - eyes.z);
        const bones::look_at::Turns turns = bones::look_at::turns_to(chart, forward, to_ball, gaze);
        static_cast<std::ostream&>(file) << time;
        file << ball << reach.elbow << reach.tip << turns.body << turns.head;
        static_cast<std::ostream&>(file) << '\n';
    }
    return file.flush() ? 0 : 1;
}
