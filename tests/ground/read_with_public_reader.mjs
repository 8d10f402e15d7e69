// Reads an MCAP file with the public reader (@mcap/core) and its samples with the public IDL parser and CDR reader
// (@foxglove/omgidl-*), and prints what it found, a line a channel: topic, schema, schema encoding, message encoding,
// messages by the index, messages by the stream, and the frame and the last value of the newest sample. Every
// checksum is checked. The modules are taken from the folder given first.
import { createRequire } from "node:module";
import { open, readFile } from "node:fs/promises";

const [folder, path] = process.argv.slice(2);
const require = createRequire(folder + "/");
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { parseIDL } = require("@foxglove/omgidl-parser");
const { MessageReader } = require("@foxglove/omgidl-serialization");
const { decompress } = require("fzstd");
const decompressHandlers = { zstd: (bytes) => decompress(bytes) };

const file = await open(path);
const readable = {
  size: async () => BigInt((await file.stat()).size),
  read: async (offset, size) => {
    const bytes = new Uint8Array(Number(size));
    await file.read(bytes, 0, Number(size), Number(offset));
    return bytes;
  },
};
const indexed = await McapIndexedReader.Initialize({ readable, decompressHandlers });
const byIndex = new Map();
const newest = new Map();
for await (const message of indexed.readMessages()) {
  byIndex.set(message.channelId, (byIndex.get(message.channelId) ?? 0) + 1);
  newest.set(message.channelId, message.data);
}

const definitions = new Map();
function decoded(schema, data) {
  const text = new TextDecoder().decode(schema.data);
  if (!definitions.has(text)) definitions.set(text, parseIDL(text));
  return new MessageReader(schema.name, definitions.get(text)).readMessage(data);
}

const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
stream.append(new Uint8Array(await readFile(path)));
const byStream = new Map();
for (let record = stream.nextRecord(); record; record = stream.nextRecord())
  if (record.type === "Message") byStream.set(record.channelId, (byStream.get(record.channelId) ?? 0) + 1);
if (!stream.done()) throw new Error("the file does not end as it should");

for (const channel of indexed.channelsById.values()) {
  const schema = indexed.schemasById.get(channel.schemaId);
  const sample = newest.has(channel.id) ? decoded(schema, newest.get(channel.id)) : {};
  const summary = sample.frame === undefined ? [] : [`frame=${sample.frame}`];
  if (sample.rig_from_j2000) summary.push(`w=${sample.rig_from_j2000.w}`, `stars=${sample.stars_used}`);
  if (sample.dots?.length) summary.push(`u=${sample.dots[sample.dots.length - 1].u_px}`);
  console.log(channel.topic, schema.name, schema.encoding, channel.messageEncoding,
    byIndex.get(channel.id) ?? 0, byStream.get(channel.id) ?? 0, ...summary);
}
