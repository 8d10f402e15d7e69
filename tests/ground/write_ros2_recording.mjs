// Writes a recording as ROS 2 does (ros2 bag record -s mcap) with the public MCAP writer (@mcap/core) and the public
// serialiser of ROS 2 messages (@foxglove/rosmsg2-serialization), both from the folder given first: ten frames 0.1 s apart,
// of /cam0 raw (mono8, rows of 40 bytes for 32 px; pixel x, y of frame n is n + x + y), of /cam1 raw (mono16, 1000 times that),
// of /cam2 compressed: the PNG file given last. Chunks uncompressed, "zstd" or "lz4".
import { createRequire } from "node:module";
import { open, readFile } from "node:fs/promises";

const [folder, path, compression, png] = process.argv.slice(2);
const require = createRequire(folder + "/");
const { McapWriter } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageWriter } = require("@foxglove/rosmsg2-serialization");
const zstd = require("@foxglove/wasm-zstd");

const bar = "=".repeat(80);
const header = `
${bar}
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
${bar}
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
`;
const schemas = {
  "sensor_msgs/msg/Image": `std_msgs/Header header
uint32 height
uint32 width
string encoding
uint8 is_bigendian
uint32 step
uint8[] data
` + header,
  "sensor_msgs/msg/CompressedImage": `std_msgs/Header header
string format
uint8[] data
` + header,
};

const file = await open(path, "w");
let position = 0n;
const writable = {
  position: () => position,
  write: async (bytes) => { await file.write(bytes); position += BigInt(bytes.length); },
};
await zstd.isLoaded;
// An lz4 chunk's content plays no part: it is its name that decides whether it can be read.
const compressChunk = {
  zstd: (bytes) => ({ compression: "zstd", compressedData: zstd.compress(bytes, 3) }),
  lz4: (bytes) => ({ compression: "lz4", compressedData: bytes }),
}[compression];
const writer = new McapWriter({ writable, chunkSize: 4000, compressChunk });
await writer.start({ profile: "ros2", library: "public" });

const writers = {};
const ids = {};
for (const [name, text] of Object.entries(schemas)) {
  ids[name] = await writer.registerSchema({ name, encoding: "ros2msg", data: new TextEncoder().encode(text) });
  writers[name] = new MessageWriter(parse(text, { ros2: true }));
}
const channel = async (topic, schema) => ({ schema, id: await writer.registerChannel({
  topic, schemaId: ids[schema], messageEncoding: "cdr", metadata: new Map([["offered_qos_profiles", ""]]) }) });
const raw = await channel("/cam0/image_raw", "sensor_msgs/msg/Image");
const deep = await channel("/cam1/image_raw", "sensor_msgs/msg/Image");
const packed = await channel("/cam2/image_raw/compressed", "sensor_msgs/msg/CompressedImage");

const [width, height] = [32, 24];
function image(n, step, bytes, put) {
  const data = new Uint8Array(step * height);
  const view = new DataView(data.buffer);
  for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) put(view, y * step + x * bytes, n + x + y);
  return { height, width, encoding: bytes === 1 ? "mono8" : "mono16", is_bigendian: 0, step, data };
}
const file_of_frame = new Uint8Array(await readFile(png));
for (let n = 0; n < 10; ++n) {
  const stamp = { sec: 1_700_000_000, nanosec: n * 100_000_000 };
  const time = BigInt(stamp.sec) * 1_000_000_000n + BigInt(stamp.nanosec);
  const add = async ({ id, schema }, message) => writer.addMessage({ channelId: id, sequence: n, logTime: time, publishTime: time,
    data: writers[schema].writeMessage({ header: { stamp, frame_id: "optical" }, ...message }) });
  await add(raw, image(n, 40, 1, (view, at, value) => view.setUint8(at, value)));
  await add(deep, image(n, 64, 2, (view, at, value) => view.setUint16(at, 1000 * value, true)));
  if (n !== 4) await add(packed, { format: "mono8; png compressed ", data: file_of_frame });
}
await writer.end();
await file.close();
