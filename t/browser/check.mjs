// check.mjs -- looks at pictures and pages in headless Chromium, and measures them.
//
//   sbcl --script t/browser/pictures.lisp DIRECTORY    makes what there is to check
//   cd t/browser && npm install
//   node check.mjs DIRECTORY [SCREENSHOTS]
//
// Needs Debian's package chromium, or the path of another in CHROMIUM.
//
// Each .svg: no text leaves the canvas, none touches a contact, no two texts overlap, and no line
// or outline runs through a text; the boxes are those that the browser has laid out.  As wide as a
// README, 830 px, no text is smaller than 9 px.  Each .html, 390 and 1280 wide, light and dark:
// axe-core has nothing to say, nothing is wider than the window, and no word is broken; the texts
// of its pictures are measured, too.  With SCREENSHOTS, a folder, pages and pictures are saved
// there as PNG.  Ends with 1 if anything is wrong.

import { readFileSync, readdirSync, mkdirSync } from 'node:fs'
import { createRequire } from 'node:module'
import path from 'node:path'
import { pathToFileURL } from 'node:url'
import puppeteer from 'puppeteer-core'

const [directory, screenshots] = process.argv.slice(2)
if (!directory) {
  console.error('usage: node check.mjs DIRECTORY [SCREENSHOTS]')
  process.exit(64)
}
if (screenshots) mkdirSync(screenshots, { recursive: true })

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8')
const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu'],
})
const README_WIDTH = 830, LEAST_SIZE = 9
const counts = { pictures: 0, pages: 0, texts: 0, contacts: 0, problems: 0 }

function complain(file, text) {
  counts.problems += 1
  console.log(`${file}: ${text}`)
}

// Runs in the page: what is wrong with the texts of the pictures in it.
function measure(limits) {
  const found = { problems: [], texts: 0, contacts: 0, pictures: 0 }
  const pictures = [...document.querySelectorAll('svg.sg[role=img]')]
  for (const svg of pictures.length ? pictures : [document.documentElement]) {
    found.pictures += 1
    const canvas = svg.getBoundingClientRect()
    const box = (node) => {
      const r = node.getBoundingClientRect()
      return { x0: r.left, y0: r.top, x1: r.right, y1: r.bottom, name: node.textContent }
    }
    const overlap = (a, b, by) =>
      a.x0 < b.x1 - by && b.x0 < a.x1 - by && a.y0 < b.y1 - by && b.y0 < a.y1 - by
    // The box of a text has the font's ascent and descent: 1/5 of it above and below is empty.
    const texts = [...svg.querySelectorAll('text')].map((node) => {
      const b = box(node), empty = (b.y1 - b.y0) / 5
      return { ...b, y0: b.y0 + empty, y1: b.y1 - empty }
    })
    // Lines and outlines, as segments on the screen; each text is measured against all of them.
    const segments = []
    for (const node of svg.querySelectorAll('line, polyline, polygon, rect:not(.paper)')) {
      if (node.closest('defs') || getComputedStyle(node).stroke === 'none') continue
      const matrix = node.getScreenCTM()
      const at = (x, y) => new DOMPoint(x, y).matrixTransform(matrix)
      const number = (name) => parseFloat(node.getAttribute(name) || 0)
      let points
      if (node.tagName === 'line') {
        points = [at(number('x1'), number('y1')), at(number('x2'), number('y2'))]
      } else if (node.tagName === 'rect') {
        const [x, y, w, h] = ['x', 'y', 'width', 'height'].map(number)
        points = [at(x, y), at(x + w, y), at(x + w, y + h), at(x, y + h), at(x, y)]
      } else {
        points = [...node.points].map((p) => at(p.x, p.y))
        if (node.tagName === 'polygon') points.push(points[0])
      }
      for (let i = 1; i < points.length; i++) {
        segments.push({ a: points[i - 1], b: points[i], kind: node.getAttribute('class') })
      }
    }
    // The part of a segment inside a box, by clipping it on each side (Liang and Barsky).
    const meets = ({ a, b }, r) => {
      let from = 0, to = 1
      const dx = b.x - a.x, dy = b.y - a.y
      for (const [p, q] of [[-dx, a.x - r.x0], [dx, r.x1 - a.x],
                            [-dy, a.y - r.y0], [dy, r.y1 - a.y]]) {
        if (p === 0) { if (q < 0) return false } else if (p < 0) { from = Math.max(from, q / p) }
        else { to = Math.min(to, q / p) }
      }
      return from < to
    }
    for (const text of texts) {
      const inside = { x0: text.x0 + 1, x1: text.x1 - 1, y0: text.y0 + 1, y1: text.y1 - 1 }
      const cut = segments.find((segment) => meets(segment, inside))
      if (cut) found.problems.push(`a ${cut.kind} runs through "${text.name}"`)
    }
    if (!pictures.length) {
      const size = Math.min(...[...svg.querySelectorAll('text')]
        .map((node) => parseFloat(getComputedStyle(node).fontSize)))
      const shown = size * Math.min(1, limits.width / svg.viewBox.baseVal.width)
      if (shown < limits.size) {
        found.problems.push(`its words are ${shown.toFixed(1)} px in a README`)
      }
    }
    const contacts = [...svg.querySelectorAll('.view circle.contact, .view circle.contact-hidden')]
      .map(box)
    found.texts += texts.length
    found.contacts += contacts.length
    texts.forEach((text, i) => {
      if (text.x0 < canvas.left || text.x1 > canvas.right ||
          text.y0 < canvas.top || text.y1 > canvas.bottom) {
        found.problems.push(`"${text.name}" leaves the canvas`)
      }
      for (const other of texts.slice(i + 1)) {
        if (overlap(text, other, 0.5)) {
          found.problems.push(`"${text.name}" overlaps "${other.name}"`)
        }
      }
      for (const contact of contacts) {
        if (overlap(text, contact, 0)) {
          found.problems.push(`"${text.name}" covers the contact "${contact.name}"`)
        }
      }
    })
    for (const node of svg.querySelectorAll('line, polyline, polygon, circle, rect, path')) {
      if (node.closest('defs')) continue
      const b = box(node)
      if (b.x0 < canvas.left - 1 || b.x1 > canvas.right + 1 ||
          b.y0 < canvas.top - 1 || b.y1 > canvas.bottom + 1) {
        found.problems.push(`a ${node.tagName}.${node.getAttribute('class')} leaves the canvas`)
      }
    }
  }
  return found
}

// Runs in the page: the words, or parts of words between hyphens, that are broken, though they
// would fit into a line.
function brokenWords() {
  const broken = []
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT)
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    if (node.parentElement.closest('svg, style, pre')) continue
    for (const match of node.data.matchAll(/[^\s-]+-?/g)) {
      if (match[0].length > 24) continue
      const range = document.createRange()
      range.setStart(node, match.index)
      range.setEnd(node, match.index + match[0].length)
      const lines = new Set([...range.getClientRects()].map((r) => Math.round(r.top)))
      if (lines.size > 1) broken.push(match[0])
    }
  }
  return broken
}

async function checkTexts(page, file) {
  const found = await page.evaluate(measure, { width: README_WIDTH, size: LEAST_SIZE })
  found.problems.forEach((problem) => complain(file, problem))
  counts.pictures += found.pictures
  counts.texts += found.texts
  counts.contacts += found.contacts
}

async function checkPage(page, file, name) {
  for (const width of [390, 1280]) {
    for (const scheme of ['light', 'dark']) {
      const where = `${name}, ${width} px, ${scheme}`
      await page.setViewport({ width, height: 900 })
      await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }])
      await page.goto(pathToFileURL(file))
      const wide = await page.evaluate(() => document.documentElement.scrollWidth)
      if (wide > width) complain(where, `it is ${wide} px wide`)
      const broken = await page.evaluate(brokenWords)
      if (broken.length) complain(where, `broken: ${[...new Set(broken)].slice(0, 5).join(', ')}`)
      await page.evaluate(axe)
      const result = await page.evaluate(() => window.axe.run())
      for (const violation of result.violations) {
        complain(where, `axe-core: ${violation.impact}: ${violation.id}: ${violation.help} ` +
                 `(${violation.nodes.length}; ${violation.nodes[0].target})`)
      }
      if (scheme === 'light') await checkTexts(page, where)
      if (screenshots) {
        await page.screenshot({ path: path.join(screenshots, `${name}-${width}-${scheme}.png`),
                                fullPage: true })
      }
      counts.pages += 1
    }
  }
}

const page = await browser.newPage()
for (const entry of readdirSync(directory, { recursive: true }).sort()) {
  const file = path.resolve(directory, entry)
  const name = entry.replace(/[/\\]/g, '-')
  if (entry.endsWith('.svg')) {
    await page.setViewport({ width: 1280, height: 1100 })
    await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: 'light' }])
    await page.goto(pathToFileURL(file))
    await checkTexts(page, name)
    if (screenshots) await page.screenshot({ path: path.join(screenshots, `${name}.png`) })
  } else if (entry.endsWith('.html')) {
    await checkPage(page, file, name)
  }
}
await browser.close()
console.log(`${counts.pictures} pictures, ${counts.texts} texts, ${counts.contacts} contacts, ` +
            `${counts.pages} views of pages: ${counts.problems} problems`)
process.exit(counts.problems ? 1 : 0)
