// SPDX-License-Identifier: MIT
// Renders a job with three.js in headless Chromium, used by three.json. Serves three.html, three.js and the
// job's files, and writes the image that the page posts. README.md: how to install both.
import { spawn } from 'node:child_process';
import { randomUUID } from 'node:crypto';
import { createReadStream, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { dirname, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const file = process.argv.at(-2), job = JSON.parse(readFileSync(file));
const three = join(process.env.DIPTYCH_THREE ?? '.', 'node_modules/three'), chromium = process.env.DIPTYCH_CHROMIUM ?? 'chromium';
const types = { '.html': 'text/html', '.js': 'text/javascript' };
const key = `/${randomUUID()}/`;  // secret: other requests get 404
const placeOf = path => path === '' ? fileURLToPath(new URL('three.html', import.meta.url)) : path === 'job' ? file
  : path.startsWith('three/') ? join(three, path.slice(6)) : path.startsWith('file/') ? path.slice(4) : '';
let browser;

function end(code, line) {
  if (line) console.error(line);
  browser?.kill('SIGKILL');
  process.exit(code);
}

const server = createServer(async (request, reply) => {
  const [path, said] = request.url.slice(key.length).split('?').map(decodeURIComponent);
  if (!request.url.startsWith(key)) return reply.writeHead(404).end();
  if (request.method === 'GET') {
    reply.setHeader('Content-Type', types[extname(placeOf(path))] ?? 'application/octet-stream');
    const stream = createReadStream(placeOf(path));
    return stream.on('error', error => reply.writeHead(404).end(String(error))).pipe(reply);
  }
  const parts = [];
  for await (const part of request) parts.push(part);
  const body = Buffer.concat(parts);
  if (path !== 'picture') end(1, body.toString());
  writeFileSync(job.output.file, body);
  end(0, said && `left out: ${said}`);
});
server.listen(0, '127.0.0.1', () => {
  const flags = ['--headless=new', '--no-sandbox', '--no-first-run', '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader', `--user-data-dir=${join(dirname(file), 'profile')}`];
  browser = spawn(chromium, [...flags, `http://127.0.0.1:${server.address().port}${key}`], { stdio: 'ignore' });
  browser.on('error', error => end(1, `${chromium}: ${error.message}; set DIPTYCH_CHROMIUM to the browser`));
});
