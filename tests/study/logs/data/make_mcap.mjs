// Writes the MCAP files of this folder with MCAP's own library: npm install @mcap/core; zstd and lz4
// are the programs of these names. A row every millisecond for a fifth of a second; the command has a topic
// of its own, every second row.
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { McapWriter } from '@mcap/core';

class Memory {
  parts = []; size = 0;
  async write(bytes) { this.parts.push(Buffer.from(bytes)); this.size += bytes.length; }
  position() { return BigInt(this.size); }
}
const compressors = {
  zstd: (bytes) => execFileSync('zstd', ['-q', '-c'], { input: bytes }),
  lz4: (bytes) => execFileSync('lz4', ['-q', '-c'], { input: bytes }),
};

async function write(name, compression) {
  const memory = new Memory();
  const writer = new McapWriter({
    writable: memory, chunkSize: 8192,
    compressChunk: compression && ((bytes) => ({ compression, compressedData: compressors[compression](bytes) })),
  });
  await writer.start({ profile: '', library: 'towbench tests' });
  const schemaId = await writer.registerSchema({ name: 'any', encoding: 'jsonschema', data: Buffer.from('{}') });
  const channel = (topic, messageEncoding) => writer.registerChannel({ topic, messageEncoding, schemaId, metadata: new Map() });
  const state = await channel('/axis/state', 'json');
  const command = await channel('/axis/command', 'json');
  const image = await channel('/camera', 'protobuf');
  const add = (channelId, sequence, time, data) => writer.addMessage({
    channelId, sequence, logTime: 1_700_000_000_000_000_000n + time, publishTime: 0n, data });
  await add(image, 0, 0n, Buffer.from([1, 2, 3]));
  for (let i = 0; i < 200; ++i) {
    const time = BigInt(i) * 1_000_000n;
    if (i % 2 === 0) {
      await add(command, i, time, Buffer.from(JSON.stringify({ volts: i / 4, enabled: true })));
    }
    await add(state, i, time, Buffer.from(JSON.stringify({ position: { m: i * 0.125 }, currents: [i, -i], name: 'y' })));
  }
  await writer.end();
  writeFileSync(name, Buffer.concat(memory.parts));
}
await write('plain.mcap');
await write('zstd.mcap', 'zstd');
await write('lz4.mcap', 'lz4');
