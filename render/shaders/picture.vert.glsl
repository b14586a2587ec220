#version 150
// A rectangle without vertex data. Its corners are given in clip coordinates; the texture
// coordinates turn sensor data into an upright picture: the picture's right is -x, its top -y.
uniform vec4 rectangle;  // left, bottom, right, top
out vec2 sensor;         // 0 to 1 along x and y of the sensor

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    sensor = 1.0 - corner;
    gl_Position = vec4(mix(rectangle.xy, rectangle.zw, corner), 0.0, 1.0);
}
