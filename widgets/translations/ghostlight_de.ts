<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>Actions</name>
    <message>
        <source>&amp;Open…</source>
        <translation>Ö&amp;ffnen …</translation>
    </message>
    <message>
        <source>Open a lens file</source>
        <translation>Eine Objektivdatei öffnen</translation>
    </message>
    <message>
        <source>&amp;Gallery of Bundled Lenses…</source>
        <translation>&amp;Galerie der beiliegenden Objektive …</translation>
    </message>
    <message>
        <source>Choose a bundled lens by its layout and its flare</source>
        <translation>Ein beiliegendes Objektiv nach Schnitt und Reflexbild wählen</translation>
    </message>
    <message>
        <source>&amp;Save</source>
        <translation>&amp;Sichern</translation>
    </message>
    <message>
        <source>Save the lens in its file</source>
        <translation>Das Objektiv in seiner Datei sichern</translation>
    </message>
    <message>
        <source>Save &amp;As…</source>
        <translation>Sichern &amp;als …</translation>
    </message>
    <message>
        <source>Save the lens in another file</source>
        <translation>Das Objektiv in einer anderen Datei sichern</translation>
    </message>
    <message>
        <source>Export &amp;Lens…</source>
        <translation>&amp;Objektiv exportieren …</translation>
    </message>
    <message>
        <source>Write the lens for another program; what its format cannot hold is reported</source>
        <translation>Das Objektiv für ein anderes Programm schreiben; was dessen Format nicht fasst, wird berichtet</translation>
    </message>
    <message>
        <source>Export &amp;Unfolded Ghost…</source>
        <translation>Ent&amp;falteten Reflex exportieren …</translation>
    </message>
    <message>
        <source>The light&apos;s way along the chosen ghost as a lens of its own, a .zmx with mirrors</source>
        <translation>Der Weg des Lichts im gewählten Reflex als eigenes Objektiv, eine .zmx mit Spiegeln</translation>
    </message>
    <message>
        <source>&amp;Glass Folders…</source>
        <translation>&amp;Glasordner …</translation>
    </message>
    <message>
        <source>Folders with catalogues of glasses besides the bundled ones</source>
        <translation>Ordner mit Glaskatalogen außer den beiliegenden</translation>
    </message>
    <message>
        <source>Export Ghost &amp;Table as CSV…</source>
        <translation>Reflex&amp;tabelle als CSV exportieren …</translation>
    </message>
    <message>
        <source>Every column and every digit</source>
        <translation>Alle Spalten und alle Stellen</translation>
    </message>
    <message>
        <source>Export &amp;Flare as EXR…</source>
        <translation>Reflex&amp;bild als EXR exportieren …</translation>
    </message>
    <message>
        <source>Linear irradiance, 32-bit float, upright</source>
        <translation>Lineare Bestrahlungsstärke, 32-Bit-Gleitkomma, aufrecht</translation>
    </message>
    <message>
        <source>Export Flare as &amp;PNG…</source>
        <translation>Reflexbild als &amp;PNG exportieren …</translation>
    </message>
    <message>
        <source>As shown, at the exposure in use</source>
        <translation>Wie gezeigt, mit der eingestellten Belichtung</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>&amp;Beenden</translation>
    </message>
    <message>
        <source>Close the window</source>
        <translation>Das Fenster schließen</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Rückgängig</translation>
    </message>
    <message>
        <source>Take back the last change</source>
        <translation>Die letzte Änderung zurücknehmen</translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation>&amp;Wiederholen</translation>
    </message>
    <message>
        <source>Do it again</source>
        <translation>Sie wieder ausführen</translation>
    </message>
    <message>
        <source>Mend Unknown &amp;Glass…</source>
        <translation>Unbekanntes &amp;Glas ersetzen …</translation>
    </message>
    <message>
        <source>Go to the first glass that nobody knows, and choose one</source>
        <translation>Zum ersten unbekannten Glas gehen und eines wählen</translation>
    </message>
    <message>
        <source>&amp;Insert Surface</source>
        <translation>Fläche &amp;einfügen</translation>
    </message>
    <message>
        <source>A plane in the middle of the gap after the chosen surface</source>
        <translation>Eine Planfläche mitten im Abstand nach der gewählten Fläche</translation>
    </message>
    <message>
        <source>&amp;Delete Surface</source>
        <translation>Fläche &amp;löschen</translation>
    </message>
    <message>
        <source>Take the chosen surface out</source>
        <translation>Die gewählte Fläche herausnehmen</translation>
    </message>
    <message>
        <source>Move Surface &amp;Up</source>
        <translation>Fläche nach &amp;oben</translation>
    </message>
    <message>
        <source>Swap with the surface before</source>
        <translation>Mit der Fläche davor tauschen</translation>
    </message>
    <message>
        <source>Move Surface Do&amp;wn</source>
        <translation>Fläche nach &amp;unten</translation>
    </message>
    <message>
        <source>Swap with the surface after</source>
        <translation>Mit der Fläche danach tauschen</translation>
    </message>
    <message>
        <source>Make It the &amp;Stop</source>
        <translation>Zur &amp;Blende machen</translation>
    </message>
    <message>
        <source>The chosen surface becomes the stop</source>
        <translation>Die gewählte Fläche wird zur Blende</translation>
    </message>
    <message>
        <source>&amp;Copy Cells</source>
        <translation>Zellen &amp;kopieren</translation>
    </message>
    <message>
        <source>The chosen cells, for a spreadsheet (Ctrl+C)</source>
        <translation>Die gewählten Zellen für eine Tabellenkalkulation (Strg+C)</translation>
    </message>
    <message>
        <source>&amp;Paste Cells</source>
        <translation>Zellen e&amp;insetzen</translation>
    </message>
    <message>
        <source>Cells from a spreadsheet, from the chosen cell on (Ctrl+V)</source>
        <translation>Zellen aus einer Tabellenkalkulation, ab der gewählten Zelle (Strg+V)</translation>
    </message>
    <message>
        <source>Mark as &amp;Variable</source>
        <translation>Als &amp;variabel markieren</translation>
    </message>
    <message>
        <source>Let a fit vary the numbers in the chosen cells, or no longer</source>
        <translation>Die Zahlen der gewählten Zellen von einer Anpassung ändern lassen, oder nicht mehr</translation>
    </message>
    <message>
        <source>A&amp;utomatic Semi-Diameter</source>
        <translation>A&amp;utomatischer Halbdurchmesser</translation>
    </message>
    <message>
        <source>Let the direct beam size the chosen surfaces</source>
        <translation>Die Größe der gewählten Flächen dem direkten Bündel überlassen</translation>
    </message>
    <message>
        <source>&amp;Own Thickness in This Configuration</source>
        <translation>Ei&amp;gene Dicke in dieser Konfiguration</translation>
    </message>
    <message>
        <source>The chosen surface&apos;s thickness differs in this configuration, or is as listed</source>
        <translation>Die Dicke nach der gewählten Fläche ist in dieser Konfiguration eine andere, oder die der Liste</translation>
    </message>
    <message>
        <source>Sca&amp;le Lens…</source>
        <translation>Objektiv &amp;skalieren …</translation>
    </message>
    <message>
        <source>Every length times a factor, or to a focal length</source>
        <translation>Alle Längen mal einem Faktor, oder auf eine Brennweite</translation>
    </message>
    <message>
        <source>&amp;Reverse Lens</source>
        <translation>Objektiv u&amp;mkehren</translation>
    </message>
    <message>
        <source>Turn the lens end for end</source>
        <translation>Das Objektiv von hinten nach vorn drehen</translation>
    </message>
    <message>
        <source>Glasses A&amp;bsorb</source>
        <translation>Gläser a&amp;bsorbieren</translation>
    </message>
    <message>
        <source>Internal transmittance by the glasses&apos; catalogues; else glass is lossless</source>
        <translation>Reintransmission nach den Katalogen der Gläser; sonst ist Glas verlustfrei</translation>
    </message>
    <message>
        <source>&amp;Copy Ghosts</source>
        <translation>Reflexe &amp;kopieren</translation>
    </message>
    <message>
        <source>The chosen rows with every digit, for a sheet</source>
        <translation>Die gewählten Zeilen mit allen Stellen, für eine Tabelle</translation>
    </message>
    <message>
        <source>Clear &amp;Selection</source>
        <translation>Auswahl &amp;aufheben</translation>
    </message>
    <message>
        <source>Select no ghost</source>
        <translation>Keinen Reflex auswählen</translation>
    </message>
    <message>
        <source>Show &amp;All</source>
        <translation>Alle &amp;zeigen</translation>
    </message>
    <message>
        <source>List every ghost</source>
        <translation>Jeden Reflex aufführen</translation>
    </message>
    <message>
        <source>Show Those Above 1/1000 of the Strongest</source>
        <translation>Die über 1/1000 des stärksten zeigen</translation>
    </message>
    <message>
        <source>Leave weak ghosts out of the list</source>
        <translation>Schwache Reflexe nicht aufführen</translation>
    </message>
    <message>
        <source>Show Those Above 1/100 of the Strongest</source>
        <translation>Die über 1/100 des stärksten zeigen</translation>
    </message>
    <message>
        <source>&amp;Filter…</source>
        <translation>&amp;Filter …</translation>
    </message>
    <message>
        <source>Name the ghosts to list, in words</source>
        <translation>Mit Worten sagen, welche Reflexe aufgeführt werden</translation>
    </message>
    <message>
        <source>As &amp;Table</source>
        <translation>Als &amp;Tabelle</translation>
    </message>
    <message>
        <source>One row for each ghost</source>
        <translation>Eine Zeile je Reflex</translation>
    </message>
    <message>
        <source>As &amp;Matrix</source>
        <translation>Als &amp;Matrix</translation>
    </message>
    <message>
        <source>Surfaces by surfaces, coloured by the flux of the ghost of each pair</source>
        <translation>Flächen gegen Flächen, gefärbt nach dem Lichtstrom des Reflexes jedes Paars</translation>
    </message>
    <message>
        <source>By &amp;Surface</source>
        <translation>Nach &amp;Flächen</translation>
    </message>
    <message>
        <source>What each surface feeds: which should get the better coating first</source>
        <translation>Was jede Fläche speist: welche zuerst die bessere Schicht bekommen sollte</translation>
    </message>
    <message>
        <source>&amp;Pin as A</source>
        <translation>Als A &amp;festhalten</translation>
    </message>
    <message>
        <source>Keep the lens as it is now, to compare what you edit from here on with it</source>
        <translation>Das Objektiv behalten, wie es jetzt ist, um spätere Änderungen damit zu vergleichen</translation>
    </message>
    <message>
        <source>&amp;Take A Back</source>
        <translation>A &amp;zurückholen</translation>
    </message>
    <message>
        <source>The lens becomes the pinned one again; one step that can be undone</source>
        <translation>Das Objektiv wird wieder das festgehaltene; ein Schritt, der sich zurücknehmen lässt</translation>
    </message>
    <message>
        <source>&amp;Unpin A</source>
        <translation>A &amp;loslassen</translation>
    </message>
    <message>
        <source>End the comparison</source>
        <translation>Den Vergleich beenden</translation>
    </message>
    <message>
        <source>&amp;Split the Flare</source>
        <translation>Reflexbild &amp;teilen</translation>
    </message>
    <message>
        <source>A on the left of a divider that you drag, B on its right</source>
        <translation>A links einer Trennlinie, die sich ziehen lässt, B rechts</translation>
    </message>
    <message>
        <source>&amp;Blink the Flare</source>
        <translation>Reflexbild &amp;blinken</translation>
    </message>
    <message>
        <source>A and B in turn, each for a moment</source>
        <translation>A und B im Wechsel, je einen Augenblick</translation>
    </message>
    <message>
        <source>&amp;False Colour</source>
        <translation>&amp;Falschfarben</translation>
    </message>
    <message>
        <source>Irradiance in colours, logarithmic, with a scale</source>
        <translation>Bestrahlungsstärke in Farben, logarithmisch, mit Skala</translation>
    </message>
    <message>
        <source>&amp;Clipping Warning</source>
        <translation>&amp;Überbelichtung anzeigen</translation>
    </message>
    <message>
        <source>Mark what is brighter than the screen can show</source>
        <translation>Markieren, was heller ist, als der Bildschirm zeigen kann</translation>
    </message>
    <message>
        <source>F&amp;ull Screen</source>
        <translation>&amp;Vollbild</translation>
    </message>
    <message>
        <source>The flare alone, on all of the screen</source>
        <translation>Nur das Reflexbild, auf dem ganzen Bildschirm</translation>
    </message>
    <message>
        <source>&amp;Soft Shoulder</source>
        <translation>&amp;Weiche Schulter</translation>
    </message>
    <message>
        <source>Linear up to 0.8, then bent towards white</source>
        <translation>Linear bis 0.8, dann zum Weiß gebogen</translation>
    </message>
    <message>
        <source>&amp;Linear</source>
        <translation>&amp;Linear</translation>
    </message>
    <message>
        <source>Linear, cut off at white</source>
        <translation>Linear, bei Weiß abgeschnitten</translation>
    </message>
    <message>
        <source>Lo&amp;garithmic</source>
        <translation>Lo&amp;garithmisch</translation>
    </message>
    <message>
        <source>Eight stops below white, evenly</source>
        <translation>Acht Blendenstufen unter Weiß, gleichmäßig</translation>
    </message>
    <message>
        <source>&amp;Several Fields</source>
        <translation>Mehrere &amp;Feldwinkel</translation>
    </message>
    <message>
        <source>Direct rays on axis, at 0.7 of the field and at its edge</source>
        <translation>Direkte Strahlen auf der Achse, bei 0.7 des Felds und am Rand</translation>
    </message>
    <message>
        <source>&amp;Pupils and Foci</source>
        <translation>&amp;Pupillen und Brennpunkte</translation>
    </message>
    <message>
        <source>Entrance and exit pupil, focal and principal points, foci of chosen ghosts</source>
        <translation>Ein- und Austrittspupille, Brenn- und Hauptpunkte, Brennpunkte gewählter Reflexe</translation>
    </message>
    <message>
        <source>Stopped &amp;Rays</source>
        <translation>&amp;Aufgehaltene Strahlen</translation>
    </message>
    <message>
        <source>Rays of ghosts that do not arrive, up to where they are stopped</source>
        <translation>Strahlen von Reflexen, die nicht ankommen, bis dahin, wo sie aufgehalten werden</translation>
    </message>
    <message>
        <source>&amp;Measure</source>
        <translation>&amp;Messen</translation>
    </message>
    <message>
        <source>Drag in the layout to measure a distance</source>
        <translation>Im Schnitt ziehen, um einen Abstand zu messen</translation>
    </message>
    <message>
        <source>Export La&amp;yout…</source>
        <translation>&amp;Schnitt exportieren …</translation>
    </message>
    <message>
        <source>As SVG, PDF or PNG</source>
        <translation>Als SVG, PDF oder PNG</translation>
    </message>
    <message>
        <source>Run the S&amp;weep</source>
        <translation>&amp;Durchlauf starten</translation>
    </message>
    <message>
        <source>One number of the lens or the light through its range: flares and curves</source>
        <translation>Eine Zahl des Objektivs oder des Lichts durch ihren Bereich: Reflexbilder und Kurven</translation>
    </message>
    <message>
        <source>C&amp;heck the Lens</source>
        <translation>Objektiv &amp;prüfen</translation>
    </message>
    <message>
        <source>What is suspicious in it</source>
        <translation>Was daran verdächtig ist</translation>
    </message>
    <message>
        <source>&amp;Copy Report</source>
        <translation>Bericht &amp;kopieren</translation>
    </message>
    <message>
        <source>The report&apos;s lines as text</source>
        <translation>Die Zeilen des Berichts als Text</translation>
    </message>
    <message>
        <source>Show &amp;All Lines</source>
        <translation>&amp;Alle Zeilen zeigen</translation>
    </message>
    <message>
        <source>Everything that was read</source>
        <translation>Alles, was gelesen wurde</translation>
    </message>
    <message>
        <source>Show What &amp;Matters</source>
        <translation>&amp;Wesentliches zeigen</translation>
    </message>
    <message>
        <source>Only what changes ghosts or has to be mended</source>
        <translation>Nur was Reflexe ändert oder in Ordnung zu bringen ist</translation>
    </message>
    <message>
        <source>&amp;Copy First-Order Data</source>
        <translation>Paraxiale Daten &amp;kopieren</translation>
    </message>
    <message>
        <source>With every digit, for a sheet</source>
        <translation>Mit allen Stellen, für eine Tabelle</translation>
    </message>
    <message>
        <source>&amp;Fit Layout</source>
        <translation>Schnitt &amp;einpassen</translation>
    </message>
    <message>
        <source>The whole lens in the layout</source>
        <translation>Das ganze Objektiv im Schnitt</translation>
    </message>
    <message>
        <source>Auto &amp;Exposure</source>
        <translation>Automatische &amp;Belichtung</translation>
    </message>
    <message>
        <source>Expose for all but the brightest half per cent</source>
        <translation>Für alles bis auf das hellste halbe Prozent belichten</translation>
    </message>
    <message>
        <source>&amp;Conics and Aspheres</source>
        <translation>&amp;Kegelschnitte und Asphären</translation>
    </message>
    <message>
        <source>Show these columns also where the lens has none</source>
        <translation>Diese Spalten auch zeigen, wo das Objektiv keine hat</translation>
    </message>
    <message>
        <source>&amp;Comments</source>
        <translation>Ko&amp;mmentare</translation>
    </message>
    <message>
        <source>Show the surfaces&apos; comments</source>
        <translation>Die Kommentare der Flächen zeigen</translation>
    </message>
    <message>
        <source>C&amp;urvatures Instead of Radii</source>
        <translation>Kr&amp;ümmungen statt Radien</translation>
    </message>
    <message>
        <source>Show and take 1/R in 1/mm in the first column</source>
        <translation>In der ersten Spalte 1/R in 1/mm zeigen und annehmen</translation>
    </message>
    <message>
        <source>&amp;Light Theme</source>
        <translation>&amp;Helles Aussehen</translation>
    </message>
    <message>
        <source>Dark letters on a light ground</source>
        <translation>Dunkle Schrift auf hellem Grund</translation>
    </message>
    <message>
        <source>&amp;Automatic</source>
        <translation>&amp;Automatisch</translation>
    </message>
    <message>
        <source>Draw flares with whichever was faster in a trial</source>
        <translation>Reflexbilder mit dem zeichnen, was in einem Versuch schneller war</translation>
    </message>
    <message>
        <source>&amp;CPU</source>
        <translation>&amp;Prozessor</translation>
    </message>
    <message>
        <source>Draw flares on the processor&apos;s cores</source>
        <translation>Reflexbilder auf den Kernen des Prozessors zeichnen</translation>
    </message>
    <message>
        <source>&amp;OpenGL</source>
        <translation>&amp;OpenGL</translation>
    </message>
    <message>
        <source>Draw flares on the graphics card, as long as it can</source>
        <translation>Reflexbilder auf der Grafikkarte zeichnen, solange sie es kann</translation>
    </message>
    <message>
        <source>&amp;Next Panel</source>
        <translation>&amp;Nächstes Feld</translation>
    </message>
    <message>
        <source>The keyboard goes to the next panel</source>
        <translation>Die Tastatur geht zum nächsten Feld</translation>
    </message>
    <message>
        <source>&amp;Previous Panel</source>
        <translation>&amp;Voriges Feld</translation>
    </message>
    <message>
        <source>The keyboard goes to the panel before</source>
        <translation>Die Tastatur geht zum Feld davor</translation>
    </message>
    <message>
        <source>&amp;Larger Text</source>
        <translation>&amp;Größere Schrift</translation>
    </message>
    <message>
        <source>All letters a tenth larger</source>
        <translation>Alle Buchstaben ein Zehntel größer</translation>
    </message>
    <message>
        <source>&amp;Smaller Text</source>
        <translation>&amp;Kleinere Schrift</translation>
    </message>
    <message>
        <source>All letters a tenth smaller</source>
        <translation>Alle Buchstaben ein Zehntel kleiner</translation>
    </message>
    <message>
        <source>Colours for All &amp;Eyes</source>
        <translation>Farben für alle &amp;Augen</translation>
    </message>
    <message>
        <source>Colours that colour-blind eyes tell apart</source>
        <translation>Farben, die auch Farbenblinde unterscheiden</translation>
    </message>
    <message>
        <source>&amp;Restore Panels</source>
        <translation>Felder &amp;wiederherstellen</translation>
    </message>
    <message>
        <source>All panels where they were at first</source>
        <translation>Alle Felder dort, wo sie anfangs waren</translation>
    </message>
    <message>
        <source>&amp;Help on This Panel</source>
        <translation>&amp;Hilfe zu diesem Feld</translation>
    </message>
    <message>
        <source>The user guide&apos;s page on the panel in use</source>
        <translation>Die Seite des Handbuchs zum benutzten Feld</translation>
    </message>
    <message>
        <source>&amp;Find a Command…</source>
        <translation>Befehl &amp;finden …</translation>
    </message>
    <message>
        <source>Search everything that this window can do, and do it</source>
        <translation>Alles durchsuchen, was dieses Fenster kann, und es tun</translation>
    </message>
    <message>
        <source>&amp;Keyboard Shortcuts</source>
        <translation>&amp;Tastenkürzel</translation>
    </message>
    <message>
        <source>Every key, on one page</source>
        <translation>Alle Tasten auf einer Seite</translation>
    </message>
    <message>
        <source>&amp;Tour</source>
        <translation>&amp;Rundgang</translation>
    </message>
    <message>
        <source>Three things to begin with</source>
        <translation>Drei Dinge für den Anfang</translation>
    </message>
    <message>
        <source>&amp;About Ghostlight</source>
        <translation>Ü&amp;ber Ghostlight</translation>
    </message>
    <message>
        <source>Version and licence</source>
        <translation>Version und Lizenz</translation>
    </message>
</context>
<context>
    <name>CellWords</name>
    <message>
        <source>unknown layer material</source>
        <translation>unbekanntes Schichtmaterial</translation>
    </message>
    <message>
        <source>MgF2, a catalogue name or an index above 0</source>
        <translation>MgF2, ein Name aus dem Katalog oder eine Brechzahl über 0</translation>
    </message>
    <message>
        <source>layers as index[,k]:thickness in nm, e.g. 1.38:96.4 | 2.1:50</source>
        <translation>Schichten als Brechzahl[,k]:Dicke in nm, z. B. 1.38:96.4 | 2.1:50</translation>
    </message>
    <message>
        <source>cannot read the layer</source>
        <translation>die Schicht ist nicht lesbar</translation>
    </message>
    <message>
        <source>not a usable reflectance</source>
        <translation>kein brauchbarer Reflexionsgrad</translation>
    </message>
    <message>
        <source>shares R=0.05, T=0.9 with R + T up to 1</source>
        <translation>Anteile R=0.05, T=0.9 mit R + T bis 1</translation>
    </message>
    <message>
        <source>must be above 0</source>
        <translation>muss über 0 sein</translation>
    </message>
    <message>
        <source>a radius in mm, or &apos;plane&apos;</source>
        <translation>ein Radius in mm, oder &apos;plane&apos;</translation>
    </message>
    <message>
        <source>a curvature in 1/mm</source>
        <translation>eine Krümmung in 1/mm</translation>
    </message>
    <message>
        <source>a radius cannot be 0</source>
        <translation>ein Radius kann nicht 0 sein</translation>
    </message>
    <message>
        <source>a catalogue name, &apos;nd / Vd&apos; or an index; empty for air</source>
        <translation>ein Katalogname, &apos;nd / Vd&apos; oder eine Brechzahl; leer für Luft</translation>
    </message>
    <message>
        <source>no such glass in the catalogue</source>
        <translation>kein solches Glas im Katalog</translation>
    </message>
    <message>
        <source>an index is at least 1</source>
        <translation>eine Brechzahl ist mindestens 1</translation>
    </message>
    <message>
        <source>the Abbe number is not a number above 0</source>
        <translation>die Abbe-Zahl ist keine Zahl über 0</translation>
    </message>
    <message>
        <source>A4=1.2e-5, A6=-3e-8, … or a list that starts at A4</source>
        <translation>A4=1.2e-5, A6=-3e-8, … oder eine Liste ab A4</translation>
    </message>
    <message>
        <source>powers are even, from 4 on</source>
        <translation>Potenzen sind gerade, ab 4</translation>
    </message>
    <message>
        <source>cannot read the aspheric term</source>
        <translation>der asphärische Term ist nicht lesbar</translation>
    </message>
    <message>
        <source>cannot read the coating</source>
        <translation>die Vergütung ist nicht lesbar</translation>
    </message>
    <message>
        <source>none, MgF2 λ/4 550, 1.38 λ/4 550, ideal λ/4 550, a stack 1.38:96.4 | 2.1:50, R=0.05, or a name of the coating library</source>
        <translation>none, MgF2 λ/4 550, 1.38 λ/4 550, ideal λ/4 550, ein Stapel 1.38:96.4 | 2.1:50, R=0.05, oder ein Name aus der Bibliothek der Schichten</translation>
    </message>
    <message>
        <source>a centre wavelength in nm</source>
        <translation>eine mittlere Wellenlänge in nm</translation>
    </message>
    <message>
        <source>a thickness factor</source>
        <translation>ein Dickenfaktor</translation>
    </message>
</context>
<context>
    <name>CoatingEdits</name>
    <message>
        <source>a measured table comes from a file: docs/formats-catalogues.md says how</source>
        <translation>eine gemessene Tabelle kommt aus einer Datei: docs/formats-catalogues.md sagt, wie</translation>
    </message>
    <message>
        <source>surfaces as 2-5, 8, from 1 to %1</source>
        <translation>Flächen wie 2-5, 8, von 1 bis %1</translation>
    </message>
    <message>
        <source>not a surface</source>
        <translation>keine Fläche</translation>
    </message>
    <message>
        <source>not a range of surfaces</source>
        <translation>kein Bereich von Flächen</translation>
    </message>
    <message>
        <source>no surface is named</source>
        <translation>keine Fläche genannt</translation>
    </message>
</context>
<context>
    <name>ConfigurationEdits</name>
    <message>
        <source>the lens as listed keeps its name</source>
        <translation>das Objektiv wie aufgeführt behält seinen Namen</translation>
    </message>
    <message>
        <source>a configuration needs a name</source>
        <translation>eine Konfiguration braucht einen Namen</translation>
    </message>
    <message>
        <source>the name is taken</source>
        <translation>der Name ist vergeben</translation>
    </message>
    <message>
        <source>another name</source>
        <translation>ein anderer Name</translation>
    </message>
    <message>
        <source>choose a configuration: the lens as listed stays</source>
        <translation>eine Konfiguration wählen: das Objektiv wie aufgeführt bleibt</translation>
    </message>
</context>
<context>
    <name>FindingsModel</name>
    <message>
        <source>Surface</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>Cell</source>
        <translation>Zelle</translation>
    </message>
    <message>
        <source>Finding</source>
        <translation>Befund</translation>
    </message>
    <message>
        <source>Proposal</source>
        <translation>Vorschlag</translation>
    </message>
</context>
<context>
    <name>FitGhostModel</name>
    <message>
        <source>Counts</source>
        <translation>Zählt</translation>
    </message>
    <message>
        <source>Signal/noise</source>
        <translation>Signal/Rauschen</translation>
    </message>
    <message>
        <source>Before, %</source>
        <translation>Vorher, %</translation>
    </message>
    <message>
        <source>After, %</source>
        <translation>Nachher, %</translation>
    </message>
    <message>
        <source>Gain</source>
        <translation>Stärke</translation>
    </message>
    <message>
        <source>In the fit</source>
        <translation>In der Anpassung</translation>
    </message>
    <message>
        <source>A ghost by its two surfaces; only what is marked counts in the fit</source>
        <translation>Ein Reflex nach seinen zwei Flächen; nur was markiert ist, zählt in der Anpassung</translation>
    </message>
    <message>
        <source>√Σ (model / σ)² over the samples of the photograph that shows it best</source>
        <translation>√Σ (Modell / σ)² über die Stichproben der Aufnahme, die ihn am besten zeigt</translation>
    </message>
    <message>
        <source>Its share of the model&apos;s light on the samples, before the fit</source>
        <translation>Sein Anteil am Licht des Modells in den Stichproben, vor der Anpassung</translation>
    </message>
    <message>
        <source>Its share of the model&apos;s light on the samples, after the fit</source>
        <translation>Sein Anteil am Licht des Modells in den Stichproben, nach der Anpassung</translation>
    </message>
    <message>
        <source>Its light in the photograph over the fitted model&apos;s, all ghosts unmixed together</source>
        <translation>Sein Licht in der Aufnahme über dem des angepassten Modells, alle Reflexe zusammen entmischt</translation>
    </message>
    <message>
        <source>Below the noise: left out by the fit, with the most that its signal to noise can be, its coatings six times as bright as at the start</source>
        <translation>Unter dem Rauschen: von der Anpassung ausgelassen, mit dem größten Signal zu Rauschen, das er haben kann, wenn seine Vergütungen sechsmal so hell sind wie zu Beginn</translation>
    </message>
</context>
<context>
    <name>FitParameterModel</name>
    <message>
        <source>Varies</source>
        <translation>Variiert</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Beginn</translation>
    </message>
    <message>
        <source>Lower</source>
        <translation>Untere</translation>
    </message>
    <message>
        <source>Upper</source>
        <translation>Obere</translation>
    </message>
    <message>
        <source>Prior ±</source>
        <translation>Vorwissen ±</translation>
    </message>
    <message>
        <source>Fitted</source>
        <translation>Angepasst</translation>
    </message>
    <message>
        <source>Std. error</source>
        <translation>Std.-Fehler</translation>
    </message>
    <message>
        <source>Known</source>
        <translation>Bekannt</translation>
    </message>
    <message>
        <source>A number of the lens; only what is marked is varied</source>
        <translation>Eine Zahl des Objektivs; nur was markiert ist, wird variiert</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>The lens&apos;s own value, where the fit begins</source>
        <translation>Der Wert des Objektivs selbst, mit dem die Anpassung beginnt</translation>
    </message>
    <message>
        <source>The fit stays above this</source>
        <translation>Die Anpassung bleibt darüber</translation>
    </message>
    <message>
        <source>The fit stays below this</source>
        <translation>Die Anpassung bleibt darunter</translation>
    </message>
    <message>
        <source>Standard deviation of what the shop makes, about the start</source>
        <translation>Standardabweichung dessen, was die Fertigung macht, um den Beginn</translation>
    </message>
    <message>
        <source>What explains the photographs best</source>
        <translation>Was die Aufnahmen am besten erklärt</translation>
    </message>
    <message>
        <source>Standard error, widened for the misfit</source>
        <translation>Standardfehler, um den Rest der Anpassung erweitert</translation>
    </message>
    <message>
        <source>Determined: narrower than half its prior. Weak: narrower, but by less. Prior: the photographs say nothing. Not felt: no visible ghost depends on it. At bound: its error means little</source>
        <translation>Bestimmt: enger als das halbe Vorwissen. Schwach: enger, aber um weniger. Vorwissen: die Aufnahmen sagen nichts. Nicht gefühlt: kein sichtbarer Reflex hängt davon ab. An Grenze: ihr Fehler sagt wenig</translation>
    </message>
    <message>
        <source>95 % interval; P by the number&apos;s profile likelihood</source>
        <translation>95-%-Intervall; P nach der Profil-Likelihood der Zahl</translation>
    </message>
</context>
<context>
    <name>FlareOverlay</name>
    <message>
        <source>irradiance %1 E₀</source>
        <translation>Bestrahlungsstärke %1 E₀</translation>
    </message>
    <message>
        <source>no ghost here</source>
        <translation>kein Reflex hier</translation>
    </message>
    <message>
        <source>E / E₀</source>
        <translation>E / E₀</translation>
    </message>
</context>
<context>
    <name>GhostTableModel</name>
    <message>
        <source>Ghost</source>
        <translation>Reflex</translation>
    </message>
    <message>
        <source>name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>First and second reflection: 5-3 turns at surface 5, then at 3.</source>
        <translation>Erste und zweite Spiegelung: 5-3 kehrt an Fläche 5 um, dann an 3.</translation>
    </message>
    <message>
        <source>Flux mm²</source>
        <translation>Fluss mm²</translation>
    </message>
    <message>
        <source>flux</source>
        <translation>Fluss</translation>
    </message>
    <message>
        <source>Effective collecting area: the ghost&apos;s flux over the light&apos;s irradiance E0,
polarisation carried along the path.</source>
        <translation>Wirksame Sammelfläche: der Lichtstrom des Reflexes geteilt durch die Bestrahlungsstärke E0 des Lichts,
mit Polarisation entlang des Wegs.</translation>
    </message>
    <message>
        <source>Flux on a logarithmic scale, four decades below the strongest ghost.</source>
        <translation>Fluss auf logarithmischer Skala, vier Dekaden unter dem stärksten Reflex.</translation>
    </message>
    <message>
        <source>Rel.</source>
        <translation>Rel.</translation>
    </message>
    <message>
        <source>relative flux</source>
        <translation>relativer Fluss</translation>
    </message>
    <message>
        <source>Flux over that of the direct image.</source>
        <translation>Fluss geteilt durch den des direkten Bilds.</translation>
    </message>
    <message>
        <source>Peak E0</source>
        <translation>Spitze E0</translation>
    </message>
    <message>
        <source>peak</source>
        <translation>Spitze</translation>
    </message>
    <message>
        <source>Largest mean irradiance over a cell of sensor width / 1280, in units of E0.</source>
        <translation>Größte mittlere Bestrahlungsstärke über eine Zelle von Sensorbreite / 1280, in Einheiten von E0.</translation>
    </message>
    <message>
        <source>x mm</source>
        <translation>x mm</translation>
    </message>
    <message>
        <source>x</source>
        <translation>x</translation>
    </message>
    <message>
        <source>Centroid on the sensor plane, horizontal.</source>
        <translation>Schwerpunkt auf der Sensorebene, waagerecht.</translation>
    </message>
    <message>
        <source>y mm</source>
        <translation>y mm</translation>
    </message>
    <message>
        <source>y</source>
        <translation>y</translation>
    </message>
    <message>
        <source>Centroid on the sensor plane, vertical; pictures are upright,
so that their top is −y.</source>
        <translation>Schwerpunkt auf der Sensorebene, senkrecht; Bilder stehen aufrecht,
sodass ihr oberer Rand −y ist.</translation>
    </message>
    <message>
        <source>RMS mm</source>
        <translation>RMS mm</translation>
    </message>
    <message>
        <source>RMS radius</source>
        <translation>RMS-Radius</translation>
    </message>
    <message>
        <source>Root mean square radius about the centroid.</source>
        <translation>Quadratisches Mittel des Radius um den Schwerpunkt.</translation>
    </message>
    <message>
        <source>On sensor %</source>
        <translation>Auf Sensor %</translation>
    </message>
    <message>
        <source>share on the sensor</source>
        <translation>Anteil auf dem Sensor</translation>
    </message>
    <message>
        <source>Share of the flux inside the sensor&apos;s rectangle.</source>
        <translation>Anteil des Flusses im Rechteck des Sensors.</translation>
    </message>
    <message>
        <source>R1 %</source>
        <translation>R1 %</translation>
    </message>
    <message>
        <source>first reflectance</source>
        <translation>erstem Reflexionsgrad</translation>
    </message>
    <message>
        <source>Mean reflectance at the first reflection.</source>
        <translation>Mittlerer Reflexionsgrad an der ersten Spiegelung.</translation>
    </message>
    <message>
        <source>R2 %</source>
        <translation>R2 %</translation>
    </message>
    <message>
        <source>second reflectance</source>
        <translation>zweitem Reflexionsgrad</translation>
    </message>
    <message>
        <source>Mean reflectance at the second reflection.</source>
        <translation>Mittlerer Reflexionsgrad an der zweiten Spiegelung.</translation>
    </message>
    <message>
        <source>Angle 1 °</source>
        <translation>Winkel 1 °</translation>
    </message>
    <message>
        <source>first angle of incidence</source>
        <translation>erstem Einfallswinkel</translation>
    </message>
    <message>
        <source>Mean angle of incidence at the first reflection, in the medium the light comes from.</source>
        <translation>Mittlerer Einfallswinkel an der ersten Spiegelung, im Medium, aus dem das Licht kommt.</translation>
    </message>
    <message>
        <source>Angle 2 °</source>
        <translation>Winkel 2 °</translation>
    </message>
    <message>
        <source>second angle of incidence</source>
        <translation>zweitem Einfallswinkel</translation>
    </message>
    <message>
        <source>Mean angle of incidence at the second reflection, in the medium the light comes from.</source>
        <translation>Mittlerer Einfallswinkel an der zweiten Spiegelung, im Medium, aus dem das Licht kommt.</translation>
    </message>
    <message>
        <source>Focus mm</source>
        <translation>Fokus mm</translation>
    </message>
    <message>
        <source>ghost focus</source>
        <translation>Fokus des Reflexes</translation>
    </message>
    <message>
        <source>Where a collimated beam meets along the ghost&apos;s path, to first order;
negative before the sensor.</source>
        <translation>Wo sich ein paralleles Bündel auf dem Weg des Reflexes trifft, in erster Ordnung;
negativ vor dem Sensor.</translation>
    </message>
    <message>
        <source>Width mm</source>
        <translation>Breite mm</translation>
    </message>
    <message>
        <source>width</source>
        <translation>Breite</translation>
    </message>
    <message>
        <source>Extent on the sensor plane, horizontal.</source>
        <translation>Ausdehnung auf der Sensorebene, waagerecht.</translation>
    </message>
    <message>
        <source>Height mm</source>
        <translation>Höhe mm</translation>
    </message>
    <message>
        <source>height</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>Extent on the sensor plane, vertical.</source>
        <translation>Ausdehnung auf der Sensorebene, senkrecht.</translation>
    </message>
    <message>
        <source>Flux A mm²</source>
        <translation>Fluss A mm²</translation>
    </message>
    <message>
        <source>flux of A</source>
        <translation>Fluss von A</translation>
    </message>
    <message>
        <source>The same ghost&apos;s flux in the pinned lens A.</source>
        <translation>Der Fluss desselben Reflexes im festgehaltenen Objektiv A.</translation>
    </message>
    <message>
        <source>B − A mm²</source>
        <translation>B − A mm²</translation>
    </message>
    <message>
        <source>difference from A</source>
        <translation>Differenz zu A</translation>
    </message>
    <message>
        <source>What the ghost gained since A was pinned; negative where it is weaker now.</source>
        <translation>Was der Reflex gewann, seit A festgehalten wurde; negativ, wo er jetzt schwächer ist.</translation>
    </message>
    <message>
        <source>A → B</source>
        <translation>A → B</translation>
    </message>
    <message>
        <source>change from A</source>
        <translation>Änderung gegen A</translation>
    </message>
    <message>
        <source>Flux now over flux of A: × 0.5 is half as strong as in the pinned lens.</source>
        <translation>Fluss jetzt durch Fluss von A: × 0.5 ist halb so stark wie im festgehaltenen Objektiv.</translation>
    </message>
    <message>
        <source>Rays</source>
        <translation>Strahlen</translation>
    </message>
    <message>
        <source>rays</source>
        <translation>Strahlen</translation>
    </message>
    <message>
        <source>Rays traced for this row&apos;s numbers.</source>
        <translation>Für die Zahlen dieser Zeile verfolgte Strahlen.</translation>
    </message>
</context>
<context>
    <name>HelpPages</name>
    <message>
        <source>Keyboard shortcuts</source>
        <translation>Tastenkürzel</translation>
    </message>
    <message>
        <source>In a panel</source>
        <translation>In einem Feld</translation>
    </message>
    <message>
        <source>F2, or typing</source>
        <translation>F2, oder tippen</translation>
    </message>
    <message>
        <source>edit the cell</source>
        <translation>die Zelle bearbeiten</translation>
    </message>
    <message>
        <source>next, previous field</source>
        <translation>nächstes, voriges Eingabefeld</translation>
    </message>
    <message>
        <source>Up, Down</source>
        <translation>Auf, Ab</translation>
    </message>
    <message>
        <source>a step more, a step less in a number</source>
        <translation>eine Zahl um einen Schritt größer, kleiner</translation>
    </message>
    <message>
        <source>the whole lens, the whole picture</source>
        <translation>das ganze Objektiv, das ganze Bild</translation>
    </message>
    <message>
        <source>copy the chosen rows with every digit</source>
        <translation>die gewählten Zeilen mit allen Stellen kopieren</translation>
    </message>
    <message>
        <source>the menus, by their underlined letters</source>
        <translation>die Menüs, über ihre unterstrichenen Buchstaben</translation>
    </message>
    <message>
        <source>Lens-flare analysis workbench. BSD 3-clause licence.</source>
        <translation>Werkbank zur Analyse von Objektivreflexen. BSD-Lizenz (3 Klauseln).</translation>
    </message>
    <message>
        <source>Processor</source>
        <translation>Prozessor</translation>
    </message>
    <message>
        <source>%1, %2 threads</source>
        <translation>%1, %2 Threads</translation>
    </message>
</context>
<context>
    <name>LayoutExport</name>
    <message>
        <source>cannot write the drawing</source>
        <translation>die Zeichnung lässt sich nicht schreiben</translation>
    </message>
    <message>
        <source>a file that can be written</source>
        <translation>eine beschreibbare Datei</translation>
    </message>
    <message>
        <source>not a kind of drawing</source>
        <translation>keine Art von Zeichnung</translation>
    </message>
    <message>
        <source>a name that ends in .svg, .pdf or .png</source>
        <translation>ein Name mit der Endung .svg, .pdf oder .png</translation>
    </message>
</context>
<context>
    <name>LayoutOverlay</name>
    <message>
        <source>sensor</source>
        <translation>Sensor</translation>
    </message>
    <message>
        <source>surface %1 · %2 · %3° · R %4 % · T %5 %</source>
        <translation>Fläche %1 · %2 · %3° · R %4 % · T %5 %</translation>
    </message>
    <message>
        <source>reflected</source>
        <translation>gespiegelt</translation>
    </message>
    <message>
        <source>passes</source>
        <translation>geht durch</translation>
    </message>
    <message>
        <source>%1 mm   along %2   across %3</source>
        <translation>%1 mm   längs %2   quer %3</translation>
    </message>
</context>
<context>
    <name>LensFilters</name>
    <message>
        <source>All lens files (%1)</source>
        <translation>Alle Objektivdateien (%1)</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
</context>
<context>
    <name>LensQuantities</name>
    <message>
        <source>Focal length</source>
        <translation>Brennweite</translation>
    </message>
    <message>
        <source>Back focal distance</source>
        <translation>Bildseitige Schnittweite</translation>
    </message>
    <message>
        <source>Front focal distance</source>
        <translation>Dingseitige Schnittweite</translation>
    </message>
    <message>
        <source>F-number</source>
        <translation>Blendenzahl</translation>
    </message>
    <message>
        <source>Entrance pupil, place</source>
        <translation>Eintrittspupille, Lage</translation>
    </message>
    <message>
        <source>Entrance pupil, radius</source>
        <translation>Eintrittspupille, Radius</translation>
    </message>
    <message>
        <source>Exit pupil, place</source>
        <translation>Austrittspupille, Lage</translation>
    </message>
    <message>
        <source>Exit pupil, radius</source>
        <translation>Austrittspupille, Radius</translation>
    </message>
    <message>
        <source>Sensor distance</source>
        <translation>Sensorabstand</translation>
    </message>
    <message>
        <source>Defocus</source>
        <translation>Defokussierung</translation>
    </message>
    <message>
        <source>Ghosts</source>
        <translation>Reflexe</translation>
    </message>
    <message>
        <source>Front principal point</source>
        <translation>Dingseitiger Hauptpunkt</translation>
    </message>
    <message>
        <source>Rear principal point</source>
        <translation>Bildseitiger Hauptpunkt</translation>
    </message>
    <message>
        <source>Front nodal point</source>
        <translation>Dingseitiger Knotenpunkt</translation>
    </message>
    <message>
        <source>Rear nodal point</source>
        <translation>Bildseitiger Knotenpunkt</translation>
    </message>
    <message>
        <source>Pupil magnification</source>
        <translation>Pupillenmaßstab</translation>
    </message>
    <message>
        <source>Working f-number</source>
        <translation>Wirksame Blendenzahl</translation>
    </message>
    <message>
        <source>Numerical aperture</source>
        <translation>Numerische Apertur</translation>
    </message>
    <message>
        <source>Image height</source>
        <translation>Bildhöhe</translation>
    </message>
    <message>
        <source>Half field, to the corner</source>
        <translation>Halbes Feld, zur Ecke</translation>
    </message>
    <message>
        <source>Half field, to first order</source>
        <translation>Halbes Feld, paraxial</translation>
    </message>
    <message>
        <source>Half field, horizontal</source>
        <translation>Halbes Feld, waagerecht</translation>
    </message>
    <message>
        <source>Half field, vertical</source>
        <translation>Halbes Feld, senkrecht</translation>
    </message>
    <message>
        <source>Total track</source>
        <translation>Baulänge</translation>
    </message>
    <message>
        <source>Petzval sum</source>
        <translation>Petzval-Summe</translation>
    </message>
    <message>
        <source>Higher reflections</source>
        <translation>Höhere Spiegelungen</translation>
    </message>
</context>
<context>
    <name>NoteTableModel</name>
    <message>
        <source>Where</source>
        <translation>Wo</translation>
    </message>
    <message>
        <source>The place in the file. Click a row that is about a surface to go to that surface.</source>
        <translation>Die Stelle in der Datei. Ein Klick auf eine Zeile, die eine Fläche betrifft, geht zu dieser Fläche.</translation>
    </message>
    <message>
        <source>What became</source>
        <translation>Was wurde</translation>
    </message>
    <message>
        <source>read, converted to another unit or form, assumed where the file says nothing,
left out, or taken as it is and noticed as odd.</source>
        <translation>gelesen, in eine andere Einheit oder Form gewandelt, angenommen, wo die Datei nichts sagt,
ausgelassen, oder genommen, wie es ist, und als seltsam vermerkt.</translation>
    </message>
    <message>
        <source>For flare</source>
        <translation>Für Reflexe</translation>
    </message>
    <message>
        <source>&apos;matters&apos;: changes where ghosts land, or how bright they are.
&apos;mend&apos;: the lens cannot be traced until this is mended.</source>
        <translation>&apos;wesentlich&apos;: ändert, wo Reflexe landen oder wie hell sie sind.
&apos;ersetzen&apos;: das Objektiv lässt sich erst verfolgen, wenn dies in Ordnung ist.</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>What was found.</source>
        <translation>Was gefunden wurde.</translation>
    </message>
    <message>
        <source>Proposal</source>
        <translation>Vorschlag</translation>
    </message>
    <message>
        <source>What can be done about it.</source>
        <translation>Was sich tun lässt.</translation>
    </message>
</context>
<context>
    <name>PrescriptionCells</name>
    <message>
        <source>a curvature in 1/mm</source>
        <translation>eine Krümmung in 1/mm</translation>
    </message>
    <message>
        <source>a thickness in mm</source>
        <translation>eine Dicke in mm</translation>
    </message>
    <message>
        <source>a semi-diameter in mm, above 0, or &apos;auto&apos;</source>
        <translation>ein Halbdurchmesser in mm, über 0, oder &apos;auto&apos;</translation>
    </message>
    <message>
        <source>the stop&apos;s own radius is what sizes the beam: give it a number</source>
        <translation>der Radius der Blende selbst bestimmt das Bündel: er braucht eine Zahl</translation>
    </message>
    <message>
        <source>a conic constant</source>
        <translation>eine Kegelschnittkonstante</translation>
    </message>
    <message>
        <source>this cell cannot be edited</source>
        <translation>diese Zelle lässt sich nicht bearbeiten</translation>
    </message>
    <message>
        <source>stop</source>
        <translation>Blende</translation>
    </message>
    <message>
        <source>cemented</source>
        <translation>gekittet</translation>
    </message>
    <message>
        <source>
Nearest names: %1</source>
        <translation>
Ähnlichste Namen: %1</translation>
    </message>
    <message>
        <source>
Type a catalogue name, or nd / Vd.</source>
        <translation>
Einen Katalognamen tippen, oder nd / Vd.</translation>
    </message>
    <message>
        <source>Radius %1 mm</source>
        <translation>Radius %1 mm</translation>
    </message>
    <message>
        <source>Curvature %1 /mm</source>
        <translation>Krümmung %1 /mm</translation>
    </message>
    <message>
        <source>Automatic: lets the direct beam through, and follows edits.
Type a number to fix it.</source>
        <translation>Automatisch: lässt das direkte Bündel durch und folgt Änderungen.
Eine Zahl hält ihn fest.</translation>
    </message>
    <message>
        <source>Fixed. Type &apos;auto&apos; to let the direct beam size it.</source>
        <translation>Fest. &apos;auto&apos; überlässt ihn dem direkten Bündel.</translation>
    </message>
    <message>
        <source>Set by the configuration %1; as listed %2 mm</source>
        <translation>Von der Konfiguration %1 gesetzt; wie aufgeführt %2 mm</translation>
    </message>
    <message>
        <source>The sensor is at the paraxial focus instead.</source>
        <translation>Der Sensor ist stattdessen im paraxialen Brennpunkt.</translation>
    </message>
    <message>
        <source>To the sensor</source>
        <translation>Zum Sensor</translation>
    </message>
    <message>
        <source>Curvature</source>
        <translation>Krümmung</translation>
    </message>
    <message>
        <source>Radius</source>
        <translation>Radius</translation>
    </message>
    <message>
        <source>Thickness</source>
        <translation>Dicke</translation>
    </message>
    <message>
        <source>Index</source>
        <translation>Brechzahl</translation>
    </message>
    <message>
        <source>Semi-diameter</source>
        <translation>Halbdurchmesser</translation>
    </message>
    <message>
        <source>Conic</source>
        <translation>Kegelschnitt</translation>
    </message>
    <message>
        <source>Thickness factor</source>
        <translation>Dickenfaktor</translation>
    </message>
    <message>
        <source>Layer %1</source>
        <translation>Schicht %1</translation>
    </message>
    <message>
        <source>there is no number in this cell</source>
        <translation>in dieser Zelle ist keine Zahl</translation>
    </message>
    <message>
        <source>a radius cannot be 0</source>
        <translation>ein Radius kann nicht 0 sein</translation>
    </message>
    <message>
        <source>an index is at least 1</source>
        <translation>eine Brechzahl ist mindestens 1</translation>
    </message>
</context>
<context>
    <name>PrescriptionClipboard</name>
    <message>
        <source>choose the cell where pasting begins</source>
        <translation>die Zelle wählen, an der das Einsetzen beginnt</translation>
    </message>
    <message>
        <source>more rows than there are surfaces</source>
        <translation>mehr Zeilen, als es Flächen gibt</translation>
    </message>
    <message numerus="yes">
        <source>%n row(s)</source>
        <translation>
            <numerusform>%n Zeile</numerusform>
            <numerusform>%n Zeilen</numerusform>
        </translation>
    </message>
    <message>
        <source>at most %1 from surface %2 on; insert surfaces first</source>
        <translation>höchstens %1 ab Fläche %2; zuerst Flächen einfügen</translation>
    </message>
    <message>
        <source>more columns than the table shows</source>
        <translation>mehr Spalten, als die Tabelle zeigt</translation>
    </message>
    <message numerus="yes">
        <source>%n column(s)</source>
        <translation>
            <numerusform>%n Spalte</numerusform>
            <numerusform>%n Spalten</numerusform>
        </translation>
    </message>
    <message>
        <source>at most %1 from the chosen one on</source>
        <translation>höchstens %1 ab der gewählten</translation>
    </message>
</context>
<context>
    <name>PrescriptionEdits</name>
    <message>
        <source>a lens keeps at least one surface</source>
        <translation>ein Objektiv behält mindestens eine Fläche</translation>
    </message>
    <message>
        <source>surface %1 is the stop: make another one the stop first</source>
        <translation>Fläche %1 ist die Blende: zuerst eine andere zur Blende machen</translation>
    </message>
    <message>
        <source>there is no row to move to</source>
        <translation>es gibt keine Zeile, wohin sie könnte</translation>
    </message>
    <message>
        <source>there is no row %1</source>
        <translation>es gibt keine Zeile %1</translation>
    </message>
    <message>
        <source>choose a configuration first: the lens as listed has no other values</source>
        <translation>zuerst eine Konfiguration wählen: das Objektiv wie aufgeführt hat keine anderen Werte</translation>
    </message>
</context>
<context>
    <name>PrescriptionModel</name>
    <message>
        <source>Surfaces count from 1, in the order in which light meets them.</source>
        <translation>Flächen zählen ab 1, in der Reihenfolge, in der das Licht sie trifft.</translation>
    </message>
    <message>
        <source>Radius mm</source>
        <translation>Radius mm</translation>
    </message>
    <message>
        <source>radius</source>
        <translation>Radius</translation>
    </message>
    <message>
        <source>Positive when the centre of curvature lies towards the sensor.
Empty or &apos;plane&apos; for a plane; &apos;c=0.01&apos; gives a curvature in 1/mm.
Numbers may be worked out: =2*13.2, 0.5in, 1/3.</source>
        <translation>Positiv, wenn der Krümmungsmittelpunkt zum Sensor hin liegt.
Leer oder &apos;plane&apos; für eine Ebene; &apos;c=0.01&apos; gibt eine Krümmung in 1/mm.
Zahlen dürfen gerechnet sein: =2*13.2, 0.5in, 1/3.</translation>
    </message>
    <message>
        <source>Thickness mm</source>
        <translation>Dicke mm</translation>
    </message>
    <message>
        <source>thickness</source>
        <translation>Dicke</translation>
    </message>
    <message>
        <source>To the next surface; the last one to the sensor.
In a configuration that sets it, its own value.
Numbers may be worked out: =2*13.2, 0.5in, 1/3.</source>
        <translation>Zur nächsten Fläche; die letzte zum Sensor.
In einer Konfiguration, die sie setzt, deren Wert.
Zahlen dürfen gerechnet sein: =2*13.2, 0.5in, 1/3.</translation>
    </message>
    <message>
        <source>Glass</source>
        <translation>Glas</translation>
    </message>
    <message>
        <source>glass</source>
        <translation>Glas</translation>
    </message>
    <message>
        <source>What follows the surface: a catalogue name, &apos;nd / Vd&apos; or an index.
Empty for air.</source>
        <translation>Was auf die Fläche folgt: ein Katalogname, &apos;nd / Vd&apos; oder eine Brechzahl.
Leer für Luft.</translation>
    </message>
    <message>
        <source>nd / Vd</source>
        <translation>nd / Vd</translation>
    </message>
    <message>
        <source>Index at the d line, 587.56 nm, and Abbe number of the named glass.</source>
        <translation>Brechzahl bei der d-Linie, 587.56 nm, und Abbe-Zahl des genannten Glases.</translation>
    </message>
    <message>
        <source>Semi-dia. mm</source>
        <translation>Halb-Ø mm</translation>
    </message>
    <message>
        <source>semi-diameter</source>
        <translation>Halbdurchmesser</translation>
    </message>
    <message>
        <source>Clear radius. Rays beyond it are clipped.
A number fixes it; &apos;auto&apos; lets the direct beam size it, marked A.</source>
        <translation>Freier Radius. Strahlen jenseits davon werden abgeschnitten.
Eine Zahl hält ihn fest; &apos;auto&apos; überlässt ihn dem direkten Bündel, mit A markiert.</translation>
    </message>
    <message>
        <source>Conic</source>
        <translation>Kegelschnitt</translation>
    </message>
    <message>
        <source>conic constant</source>
        <translation>Kegelschnittkonstante</translation>
    </message>
    <message>
        <source>0 sphere, −1 paraboloid, below −1 hyperboloid.</source>
        <translation>0 Kugel, −1 Paraboloid, unter −1 Hyperboloid.</translation>
    </message>
    <message>
        <source>Asphere</source>
        <translation>Asphäre</translation>
    </message>
    <message>
        <source>aspheric terms</source>
        <translation>asphärische Terme</translation>
    </message>
    <message>
        <source>Even terms of the sag, A4 r⁴ + A6 r⁶ + …, in mm^(1−power).</source>
        <translation>Gerade Terme der Pfeilhöhe, A4 r⁴ + A6 r⁶ + …, in mm^(1−Potenz).</translation>
    </message>
    <message>
        <source>Coating</source>
        <translation>Vergütung</translation>
    </message>
    <message>
        <source>coating</source>
        <translation>Vergütung</translation>
    </message>
    <message>
        <source>none, MgF2 λ/4 550, 1.38 λ/4 550, ideal λ/4 550,
or a stack from the light&apos;s side: 1.38:96.4 | 2.1:50 (nm).
The chip is the reflected colour under the chosen light.</source>
        <translation>none, MgF2 λ/4 550, 1.38 λ/4 550, ideal λ/4 550,
oder ein Stapel von der Lichtseite her: 1.38:96.4 | 2.1:50 (nm).
Das Farbfeld zeigt die gespiegelte Farbe unter dem gewählten Licht.</translation>
    </message>
    <message>
        <source>Comment</source>
        <translation>Kommentar</translation>
    </message>
    <message>
        <source>comment</source>
        <translation>Kommentar</translation>
    </message>
    <message>
        <source>Words of your own; they change nothing.</source>
        <translation>Eigene Worte; sie ändern nichts.</translation>
    </message>
    <message>
        <source>Curvature /mm</source>
        <translation>Krümmung /mm</translation>
    </message>
    <message>
        <source>curvature</source>
        <translation>Krümmung</translation>
    </message>
    <message>
        <source>1/R. Positive when the centre of curvature lies towards the sensor; 0 for a plane.
&apos;r=50&apos; gives a radius in mm. Numbers may be worked out: 1/50, 1/2in.</source>
        <translation>1/R. Positiv, wenn der Krümmungsmittelpunkt zum Sensor hin liegt; 0 für eine Ebene.
&apos;r=50&apos; gibt einen Radius in mm. Zahlen dürfen gerechnet sein: 1/50, 1/2in.</translation>
    </message>
</context>
<context>
    <name>QObject</name>
    <message>
        <source>light</source>
        <translation>Licht</translation>
    </message>
    <message>
        <source>clipped</source>
        <translation>überbelichtet</translation>
    </message>
    <message>
        <source>painted</source>
        <translation>übermalt</translation>
    </message>
    <message>
        <source>outside of the crop</source>
        <translation>außerhalb des Ausschnitts</translation>
    </message>
    <message>
        <source>no numbers</source>
        <translation>keine Zahlen</translation>
    </message>
    <message>
        <source>1 hot pixel</source>
        <translation>1 heißes Pixel</translation>
    </message>
    <message>
        <source>%1 hot pixels</source>
        <translation>%1 heiße Pixel</translation>
    </message>
    <message>
        <source>%1 masked: %2</source>
        <translation>%1 maskiert: %2</translation>
    </message>
</context>
<context>
    <name>QuantityModel</name>
    <message>
        <source>Quantity</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
</context>
<context>
    <name>StopPanel</name>
    <message>
        <source> · %1 % clear</source>
        <translation> · %1 % frei</translation>
    </message>
</context>
<context>
    <name>StopStatistics</name>
    <message numerus="yes">
        <source>%n arm(s) of the starburst</source>
        <translation>
            <numerusform>%n Strahl des Blendensterns</numerusform>
            <numerusform>%n Strahlen des Blendensterns</numerusform>
        </translation>
    </message>
    <message>
        <source>round: rings instead of arms</source>
        <translation>rund: Ringe statt Strahlen</translation>
    </message>
    <message>
        <source>%1 specks of dust take %2 % of the light</source>
        <translation>%1 Staubkörner nehmen %2 % des Lichts</translation>
    </message>
    <message numerus="yes">
        <source>%n scratch(es) take %1 %</source>
        <translation>
            <numerusform>%n Kratzer nimmt %1 %</numerusform>
            <numerusform>%n Kratzer nehmen %1 %</numerusform>
        </translation>
    </message>
    <message>
        <source>the fingerprint takes %1 %</source>
        <translation>der Fingerabdruck nimmt %1 %</translation>
    </message>
    <message>
        <source>%1 % of the light passes</source>
        <translation>%1 % des Lichts kommen durch</translation>
    </message>
    <message>
        <source>with an image, ghosts are drawn by the uniform method, whose error is not estimated</source>
        <translation>mit einem Bild werden Geisterbilder nach dem Verfahren uniform gezeichnet, dessen Fehler nicht geschätzt wird</translation>
    </message>
</context>
<context>
    <name>SurfaceSumsModel</name>
    <message>
        <source>Surface</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>By number, with its ghosts below; double-click to go to its coating.</source>
        <translation>Nach Nummer, darunter ihre Reflexe; Doppelklick geht zu ihrer Vergütung.</translation>
    </message>
    <message>
        <source>Media</source>
        <translation>Medien</translation>
    </message>
    <message>
        <source>In front of the surface and behind it; of a ghost those at its other one.</source>
        <translation>Vor und hinter der Fläche; bei einem Reflex die an seiner anderen.</translation>
    </message>
    <message>
        <source>Flux mm²</source>
        <translation>Fluss mm²</translation>
    </message>
    <message>
        <source>Of all ghosts that turn there, however often. Each counts at both of its surfaces,
so that the column adds up to more than all ghosts.</source>
        <translation>Aller Reflexe, die dort umkehren. Jeder zählt an seinen beiden Flächen,
sodass die Spalte mehr ergibt als alle Reflexe.</translation>
    </message>
    <message>
        <source>The same as a share of the largest.</source>
        <translation>Dasselbe als Anteil des größten.</translation>
    </message>
    <message>
        <source>Of all %</source>
        <translation>Von allen %</translation>
    </message>
    <message>
        <source>Share of the light of all ghosts that would be gone if this surface did not reflect.</source>
        <translation>Anteil des Lichts aller Reflexe, der fehlte, wenn diese Fläche nicht spiegelte.</translation>
    </message>
    <message>
        <source>On sensor mm²</source>
        <translation>Auf Sensor mm²</translation>
    </message>
    <message>
        <source>The part of the flux that lands on the sensor.</source>
        <translation>Der Teil des Flusses, der auf dem Sensor landet.</translation>
    </message>
    <message>
        <source>Ghosts</source>
        <translation>Reflexe</translation>
    </message>
    <message>
        <source>How many turn there.</source>
        <translation>Wie viele dort umkehren.</translation>
    </message>
</context>
<context>
    <name>UnknownGlassText</name>
    <message>
        <source>The glass</source>
        <translation>Das Glas</translation>
    </message>
    <message>
        <source>Glass %1</source>
        <translation>Das Glas %1</translation>
    </message>
    <message>
        <source>%1 after surface %2 is not known: %3.</source>
        <translation>%1 nach Fläche %2 ist unbekannt: %3.</translation>
    </message>
</context>
<context>
    <name>ghostlight::AccuracyJob</name>
    <message>
        <source>OpenGL</source>
        <translation>OpenGL</translation>
    </message>
</context>
<context>
    <name>ghostlight::AccuracyPanel</name>
    <message>
        <source>Method</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>Setting</source>
        <translation>Einstellung</translation>
    </message>
    <message>
        <source>Median, ms</source>
        <translation>Median, ms</translation>
    </message>
    <message>
        <source>p95, ms</source>
        <translation>p95, ms</translation>
    </message>
    <message>
        <source>Error, %</source>
        <translation>Fehler, %</translation>
    </message>
    <message>
        <source>Energy, %</source>
        <translation>Energie, %</translation>
    </message>
    <message>
        <source>SMAPE, %</source>
        <translation>SMAPE, %</translation>
    </message>
    <message>
        <source>Resolved</source>
        <translation>Aufgelöst</translation>
    </message>
    <message>
        <source>Front</source>
        <translation>Front</translation>
    </message>
    <message>
        <source>Relative L1 of the ghosts&apos; irradiance on the sensor</source>
        <translation>Relatives L1 der Bestrahlungsstärke der Reflexe auf dem Sensor</translation>
    </message>
    <message>
        <source>No: less than three times the reference&apos;s own error</source>
        <translation>Nein: weniger als das Dreifache des Fehlers der Referenz selbst</translation>
    </message>
    <message>
        <source>Nothing measured is both faster and closer</source>
        <translation>Nichts Gemessenes ist zugleich schneller und genauer</translation>
    </message>
    <message>
        <source>Error against time</source>
        <translation>Fehler über Zeit</translation>
    </message>
    <message>
        <source>Promised against achieved</source>
        <translation>Versprochen und erreicht</translation>
    </message>
    <message>
        <source>Table</source>
        <translation>Tabelle</translation>
    </message>
    <message>
        <source>Not computed</source>
        <translation>Nicht berechnet</translation>
    </message>
    <message>
        <source>What the picture on screen leaves out, and what that can cost</source>
        <translation>Was das Bild auf dem Schirm auslässt, und was das kosten kann</translation>
    </message>
    <message>
        <source>measuring %1</source>
        <translation>%1 wird gemessen</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>gescheitert</translation>
    </message>
    <message>
        <source>one wavelength</source>
        <translation>eine Wellenlänge</translation>
    </message>
    <message>
        <source>the light&apos;s spectrum</source>
        <translation>das Spektrum des Lichts</translation>
    </message>
    <message>
        <source>OpenGL too</source>
        <translation>auch OpenGL</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>Breite</translation>
    </message>
    <message>
        <source>Of the pictures</source>
        <translation>Der Bilder</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>What the reference may err by; the finer, the longer it takes</source>
        <translation>Was die Referenz falsch sein darf; je feiner, desto länger dauert sie</translation>
    </message>
    <message>
        <source>Budget</source>
        <translation>Zeitrahmen</translation>
    </message>
    <message>
        <source>For the timed frames, the reference not among them; settings that would go beyond it are left out</source>
        <translation>Für die gemessenen Bilder, ohne die Referenz; Einstellungen, die darüber hinaus gingen, werden ausgelassen</translation>
    </message>
    <message>
        <source>Measure OpenGL&apos;s pictures beside the CPU&apos;s</source>
        <translation>Auch die Bilder von OpenGL messen, neben denen des Prozessors</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Messen</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Sichern …</translation>
    </message>
    <message>
        <source>Tables (CSV), charts (SVG) and one HTML page into a folder</source>
        <translation>Tabellen (CSV), Diagramme (SVG) und eine HTML-Seite in einen Ordner</translation>
    </message>
    <message>
        <source>Folder for the report</source>
        <translation>Ordner für den Bericht</translation>
    </message>
    <message>
        <source>measuring</source>
        <translation>wird gemessen</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>angehalten</translation>
    </message>
    <message>
        <source>OpenGL took no part: %1</source>
        <translation>OpenGL nahm nicht teil: %1</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>ja</translation>
    </message>
    <message>
        <source>no</source>
        <translation>nein</translation>
    </message>
    <message>
        <source>reference to %1 % in %2 s · the plan kept its tolerance in %3 of %4, %5 not resolved</source>
        <translation>Referenz auf %1 % in %2 s · der Plan hielt seine Toleranz in %3 von %4, %5 nicht aufgelöst</translation>
    </message>
    <message>
        <source>The picture is being drawn.</source>
        <translation>Das Bild wird gezeichnet.</translation>
    </message>
    <message>
        <source>of another state of the lens or light; measure again</source>
        <translation>von einem anderen Stand des Objektivs oder Lichts; neu messen</translation>
    </message>
    <message>
        <source>Only the ghosts of one point light, unchanged by hand, have a plan that says all about them.</source>
        <translation>Nur für die Reflexe eines Punktlichts, von Hand unverändert, sagt ein Plan alles über sie.</translation>
    </message>
    <message>
        <source>Error against time of every way to draw this lens&apos;s flare, measured against a reference, and what the picture leaves out.</source>
        <translation>Fehler über Zeit für alle Verfahren, das Reflexbild dieses Objektivs zu zeichnen, gegen eine Referenz gemessen, und was das Bild auslässt.</translation>
    </message>
    <message>
        <source>Measures every method against a reference for the lens and light at hand.</source>
        <translation>Misst jedes Verfahren gegen eine Referenz, für das Objektiv und das Licht in der Hand.</translation>
    </message>
    <message>
        <source>Accuracy</source>
        <translation>Genauigkeit</translation>
    </message>
</context>
<context>
    <name>ghostlight::Banner</name>
    <message>
        <source>Put this message away</source>
        <translation>Diese Meldung weglegen</translation>
    </message>
</context>
<context>
    <name>ghostlight::CheckPanel</name>
    <message>
        <source>Check</source>
        <translation>Prüfung</translation>
    </message>
    <message>
        <source>What is suspicious in the lens is listed here.</source>
        <translation>Was am Objektiv verdächtig ist, steht hier.</translation>
    </message>
    <message>
        <source>Nothing suspicious was found.</source>
        <translation>Es wurde nichts Verdächtiges gefunden.</translation>
    </message>
    <message>
        <source>%1 worth knowing</source>
        <translation>%1 zu wissen</translation>
    </message>
    <message>
        <source>%1 suspicious, %2 worth knowing · click to go there</source>
        <translation>%1 verdächtig, %2 zu wissen · ein Klick geht dorthin</translation>
    </message>
</context>
<context>
    <name>ghostlight::CoatingPanel</name>
    <message>
        <source>The coating of the surface chosen in the prescription: its layers, what it reflects, and the ghosts that it feeds.</source>
        <translation>Die Vergütung der Fläche, die in den Objektivdaten gewählt ist: ihre Schichten, was sie reflektiert und welche Reflexe sie speist.</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Keine</translation>
    </message>
    <message>
        <source>Quarter wave, MgF2</source>
        <translation>Viertelwelle, MgF2</translation>
    </message>
    <message>
        <source>Quarter wave, ideal</source>
        <translation>Viertelwelle, ideal</translation>
    </message>
    <message>
        <source>Layers</source>
        <translation>Schichten</translation>
    </message>
    <message>
        <source>Constant R</source>
        <translation>Festes R</translation>
    </message>
    <message>
        <source>Measured table</source>
        <translation>Gemessene Tabelle</translation>
    </message>
    <message>
        <source>Coating</source>
        <translation>Vergütung</translation>
    </message>
    <message>
        <source>+ Layer</source>
        <translation>+ Schicht</translation>
    </message>
    <message>
        <source>A layer after the chosen one</source>
        <translation>Eine Schicht nach der gewählten</translation>
    </message>
    <message>
        <source>− Layer</source>
        <translation>− Schicht</translation>
    </message>
    <message>
        <source>Take the chosen layer away</source>
        <translation>Die gewählte Schicht wegnehmen</translation>
    </message>
    <message>
        <source>⇅ Turn</source>
        <translation>⇅ Wenden</translation>
    </message>
    <message>
        <source>The same layers in reverse order</source>
        <translation>Dieselben Schichten in umgekehrter Folge</translation>
    </message>
    <message>
        <source>R over wavelength</source>
        <translation>R über Wellenlänge</translation>
    </message>
    <message>
        <source>R over angle</source>
        <translation>R über Winkel</translation>
    </message>
    <message>
        <source>Kind of coating</source>
        <translation>Art der Vergütung</translation>
    </message>
    <message>
        <source>Material</source>
        <translation>Material</translation>
    </message>
    <message>
        <source>Layers count from the side that light comes from, or from the air</source>
        <translation>Schichten zählen von der Seite, von der das Licht kommt, oder von der Luft aus</translation>
    </message>
    <message>
        <source>MgF2, a catalogue name, or an index at every wavelength</source>
        <translation>MgF2, ein Katalogname oder eine Brechzahl bei jeder Wellenlänge</translation>
    </message>
    <message>
        <source>Thickness in nm; arithmetic is taken: =550/4/1.38</source>
        <translation>Dicke in nm; auch gerechnet: =550/4/1.38</translation>
    </message>
    <message>
        <source>Extinction k of n + ik; 0 for a layer that does not absorb</source>
        <translation>Extinktion k in n + ik; 0 für eine Schicht, die nicht absorbiert</translation>
    </message>
    <message>
        <source>from the front</source>
        <translation>von vorn</translation>
    </message>
    <message>
        <source>from behind</source>
        <translation>von hinten</translation>
    </message>
    <message>
        <source>From where the light comes: the angle is the one in the medium there</source>
        <translation>Woher das Licht kommt: der Winkel ist der im Medium dort</translation>
    </message>
    <message>
        <source>Side that the light comes from</source>
        <translation>Seite, von der das Licht kommt</translation>
    </message>
    <message>
        <source>Wavelength of the curve over the angle in nm</source>
        <translation>Wellenlänge der Kurve über dem Winkel in nm</translation>
    </message>
    <message>
        <source>Wavelength of the curve over the angle, nm</source>
        <translation>Wellenlänge der Kurve über dem Winkel, nm</translation>
    </message>
    <message>
        <source>Surfaces to copy the coating to</source>
        <translation>Flächen, auf die die Vergütung kopiert wird</translation>
    </message>
    <message>
        <source>Surfaces that get the same coating: 2-5, 8</source>
        <translation>Flächen, die dieselbe Vergütung bekommen: 2-5, 8</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Licht</translation>
    </message>
    <message>
        <source>at</source>
        <translation>bei</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>Kopieren</translation>
    </message>
    <message>
        <source>To all that face air</source>
        <translation>Auf alle an Luft</translation>
    </message>
    <message>
        <source>The same coating on every surface between air and glass</source>
        <translation>Dieselbe Vergütung auf jeder Fläche zwischen Luft und Glas</translation>
    </message>
    <message>
        <source>Copy to</source>
        <translation>Kopieren auf</translation>
    </message>
    <message>
        <source>add a layer to the coating</source>
        <translation>der Vergütung eine Schicht hinzufügen</translation>
    </message>
    <message>
        <source>remove a layer of the coating</source>
        <translation>eine Schicht der Vergütung entfernen</translation>
    </message>
    <message>
        <source>turn the coating</source>
        <translation>die Vergütung wenden</translation>
    </message>
    <message>
        <source>change coating of surface %1</source>
        <translation>Vergütung von Fläche %1 ändern</translation>
    </message>
    <message>
        <source>a thickness in nm</source>
        <translation>eine Dicke in nm</translation>
    </message>
    <message>
        <source>an extinction, 0 or more</source>
        <translation>eine Extinktion, 0 oder mehr</translation>
    </message>
    <message>
        <source>a centre wavelength in nm</source>
        <translation>eine mittlere Wellenlänge in nm</translation>
    </message>
    <message>
        <source>per cent, from 0 to 100</source>
        <translation>Prozent, von 0 bis 100</translation>
    </message>
    <message>
        <source>copy the coating of surface %1 to %2 surfaces</source>
        <translation>Vergütung von Fläche %1 auf %2 Flächen kopieren</translation>
    </message>
    <message>
        <source>table</source>
        <translation>Tabelle</translation>
    </message>
    <message>
        <source>centre nm</source>
        <translation>Mitte nm</translation>
    </message>
    <message>
        <source>at every wavelength</source>
        <translation>bei jeder Wellenlänge</translation>
    </message>
    <message>
        <source># air</source>
        <translation># Luft</translation>
    </message>
    <message>
        <source>No ghost turns here.</source>
        <translation>Kein Reflex kehrt hier um.</translation>
    </message>
    <message>
        <source>The ghosts are not traced yet.</source>
        <translation>Die Reflexe sind noch nicht berechnet.</translation>
    </message>
    <message>
        <source>&lt;a href=&quot;%1&quot;&gt;%2&lt;/a&gt; %3 mm², met at %4° (up to %5°) %6</source>
        <translation>&lt;a href=&quot;%1&quot;&gt;%2&lt;/a&gt; %3 mm², trifft unter %4° auf (bis %5°) %6</translation>
    </message>
    <message>
        <source>Feeds most: </source>
        <translation>Speist am meisten: </translation>
    </message>
    <message>
        <source>&lt;br&gt;then </source>
        <translation>&lt;br&gt;dann </translation>
    </message>
    <message>
        <source>R % over angle, %1 nm</source>
        <translation>R % über Winkel, %1 nm</translation>
    </message>
    <message>
        <source>R % over wavelength, %1°</source>
        <translation>R % über Wellenlänge, %1°</translation>
    </message>
    <message>
        <source>surface %1 · %2 to %3</source>
        <translation>Fläche %1 · %2 zu %3</translation>
    </message>
</context>
<context>
    <name>ghostlight::CommandPalette</name>
    <message>
        <source>Find a command</source>
        <translation>Befehl finden</translation>
    </message>
    <message>
        <source>Type some letters of a command, its menu or what it does</source>
        <translation>Einige Buchstaben eines Befehls, seines Menüs oder seiner Wirkung tippen</translation>
    </message>
</context>
<context>
    <name>ghostlight::ConfigurationPanel</name>
    <message>
        <source>as listed</source>
        <translation>wie aufgeführt</translation>
    </message>
    <message>
        <source>Configurations</source>
        <translation>Konfigurationen</translation>
    </message>
    <message>
        <source>+ Add</source>
        <translation>+ Neu</translation>
    </message>
    <message>
        <source>Another position like the one in hand</source>
        <translation>Eine weitere Stellung wie die gewählte</translation>
    </message>
    <message>
        <source>− Remove</source>
        <translation>− Weg</translation>
    </message>
    <message>
        <source>Take this position away</source>
        <translation>Diese Stellung wegnehmen</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Stellung</translation>
    </message>
    <message>
        <source>EFL mm</source>
        <translation>Brennweite mm</translation>
    </message>
    <message>
        <source>Own thicknesses</source>
        <translation>Eigene Dicken</translation>
    </message>
    <message>
        <source>Double-click or F2 renames</source>
        <translation>Doppelklick oder F2 benennt um</translation>
    </message>
    <message>
        <source>Surfaces whose thickness is this position&apos;s own. Edit ▸ Own Thickness in
This Configuration adds one: choose the surface in the prescription.</source>
        <translation>Flächen mit eigener Dicke in dieser Stellung. Bearbeiten ▸ Eigene Dicke in
dieser Konfiguration fügt eine hinzu: die Fläche in den Objektivdaten wählen.</translation>
    </message>
    <message>
        <source>Between two positions</source>
        <translation>Zwischen zwei Stellungen</translation>
    </message>
    <message>
        <source>From the one position to the other, linear in every thickness and the f-number.
What it makes is a position of its own; undo takes it away again.</source>
        <translation>Von der einen Stellung zur anderen, linear in jeder Dicke und der Blendenzahl.
Was dabei entsteht, ist eine eigene Stellung; Rückgängig nimmt sie wieder weg.</translation>
    </message>
    <message>
        <source>From</source>
        <translation>Von</translation>
    </message>
    <message>
        <source>To</source>
        <translation>Nach</translation>
    </message>
    <message>
        <source>add a configuration</source>
        <translation>Konfiguration hinzufügen</translation>
    </message>
    <message>
        <source>remove the configuration %1</source>
        <translation>Konfiguration %1 entfernen</translation>
    </message>
    <message>
        <source>change configuration</source>
        <translation>Konfiguration ändern</translation>
    </message>
    <message>
        <source>rename the configuration %1</source>
        <translation>Konfiguration %1 umbenennen</translation>
    </message>
    <message>
        <source>one position, as listed</source>
        <translation>eine Stellung, wie aufgeführt</translation>
    </message>
    <message numerus="yes">
        <source>%n position(s)</source>
        <translation>
            <numerusform>%n Stellung</numerusform>
            <numerusform>%n Stellungen</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ghostlight::CorrelationView</name>
    <message>
        <source>Which fitted numbers go together; after a fit.</source>
        <translation>Welche angepassten Zahlen zusammengehen; nach einer Anpassung.</translation>
    </message>
    <message>
        <source>amber +1 · teal −1 · the mouse tells the pair</source>
        <translation>Bernstein +1 · Blaugrün −1 · die Maus nennt das Paar</translation>
    </message>
</context>
<context>
    <name>ghostlight::Document</name>
    <message>
        <source>reload from disk</source>
        <translation>neu von der Platte laden</translation>
    </message>
</context>
<context>
    <name>ghostlight::FileActions</name>
    <message>
        <source>Unsaved edits</source>
        <translation>Ungesicherte Änderungen</translation>
    </message>
    <message>
        <source>%1 has edits that are not saved.</source>
        <translation>%1 hat Änderungen, die nicht gesichert sind.</translation>
    </message>
    <message>
        <source>Export lens</source>
        <translation>Objektiv exportieren</translation>
    </message>
    <message>
        <source>Choose a ghost in the table first: it is the one to export.</source>
        <translation>Zuerst einen Reflex in der Tabelle wählen: er wird exportiert.</translation>
    </message>
    <message>
        <source>Export unfolded ghost</source>
        <translation>Entfalteten Reflex exportieren</translation>
    </message>
    <message>
        <source>Zemax (*.zmx)</source>
        <translation>Zemax (*.zmx)</translation>
    </message>
    <message>
        <source>Export ghost table</source>
        <translation>Reflextabelle exportieren</translation>
    </message>
    <message>
        <source>Comma-separated values (*.csv)</source>
        <translation>Durch Komma getrennte Werte (*.csv)</translation>
    </message>
    <message>
        <source>Export flare</source>
        <translation>Reflexbild exportieren</translation>
    </message>
    <message>
        <source>OpenEXR (*.exr)</source>
        <translation>OpenEXR (*.exr)</translation>
    </message>
    <message>
        <source>Saved %1</source>
        <translation>%1 gesichert</translation>
    </message>
    <message>
        <source>lenses are saved in Ghostlight&apos;s own format; File ▸ Export Lens writes others</source>
        <translation>Objektive werden in Ghostlights eigenem Format gesichert; Datei ▸ Objektiv exportieren schreibt andere</translation>
    </message>
    <message>
        <source>a name that ends in .json</source>
        <translation>ein Name mit der Endung .json</translation>
    </message>
    <message>
        <source>the file is another program&apos;s, and is not written over</source>
        <translation>die Datei gehört einem anderen Programm und wird nicht überschrieben</translation>
    </message>
    <message>
        <source>another name</source>
        <translation>ein anderer Name</translation>
    </message>
    <message>
        <source>Save lens</source>
        <translation>Objektiv sichern</translation>
    </message>
    <message>
        <source>Ghostlight lens (*.json)</source>
        <translation>Ghostlight-Objektiv (*.json)</translation>
    </message>
    <message>
        <source>Open lens</source>
        <translation>Objektiv öffnen</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>%1 geschrieben</translation>
    </message>
    <message>
        <source>there is no ghost table yet: it is still being computed</source>
        <translation>es gibt noch keine Reflextabelle: sie wird noch berechnet</translation>
    </message>
    <message>
        <source>there is no flare yet: it is still being computed</source>
        <translation>es gibt noch kein Reflexbild: es wird noch berechnet</translation>
    </message>
    <message>
        <source>no ghost is chosen</source>
        <translation>kein Reflex ist gewählt</translation>
    </message>
    <message>
        <source>look up unknown glasses</source>
        <translation>unbekannte Gläser nachschlagen</translation>
    </message>
    <message>
        <source>No lens opened yet</source>
        <translation>Noch kein Objektiv geöffnet</translation>
    </message>
</context>
<context>
    <name>ghostlight::FileWatch</name>
    <message>
        <source>%1 was removed by another program. The lens in hand is whole; saving writes it anew.</source>
        <translation>%1 wurde von einem anderen Programm entfernt. Das geöffnete Objektiv ist ganz; Sichern schreibt die Datei neu.</translation>
    </message>
    <message>
        <source>%1 was changed by another program. Reloading can be undone.</source>
        <translation>%1 wurde von einem anderen Programm geändert. Neu laden lässt sich rückgängig machen.</translation>
    </message>
    <message>
        <source>Reload</source>
        <translation>Neu laden</translation>
    </message>
    <message>
        <source>Keep Mine</source>
        <translation>Meines behalten</translation>
    </message>
    <message>
        <source>The changed file cannot be read, and the lens in hand stays. </source>
        <translation>Die geänderte Datei ist nicht lesbar, und das geöffnete Objektiv bleibt. </translation>
    </message>
</context>
<context>
    <name>ghostlight::FindingsModel</name>
    <message>
        <source>lens</source>
        <translation>Objektiv</translation>
    </message>
</context>
<context>
    <name>ghostlight::FirstOrderPanel</name>
    <message>
        <source>The lens&apos;s first-order data: focal length, pupils, principal points, field and length.</source>
        <translation>Die paraxialen Daten des Objektivs: Brennweite, Pupillen, Hauptpunkte, Feld und Länge.</translation>
    </message>
    <message>
        <source>First order</source>
        <translation>Paraxial</translation>
    </message>
    <message>
        <source>Open a lens…</source>
        <translation>Ein Objektiv öffnen …</translation>
    </message>
    <message>
        <source>%1 nm · far object</source>
        <translation>%1 nm · fernes Objekt</translation>
    </message>
    <message>
        <source>Nothing can be worked out yet: %1</source>
        <translation>Noch lässt sich nichts berechnen: %1</translation>
    </message>
</context>
<context>
    <name>ghostlight::FitControls</name>
    <message>
        <source>Start</source>
        <translation>Start</translation>
    </message>
    <message>
        <source>Fit what is marked to the photographs</source>
        <translation>Was markiert ist, an die Aufnahmen anpassen</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Wait after the step in work</source>
        <translation>Nach dem laufenden Schritt warten</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Stop, and keep the best so far</source>
        <translation>Anhalten und das Beste bis dahin behalten</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Anwenden</translation>
    </message>
    <message>
        <source>Put the fitted numbers into the lens, as one step that can be undone</source>
        <translation>Die angepassten Zahlen ins Objektiv setzen, als ein Schritt, der sich zurücknehmen lässt</translation>
    </message>
    <message>
        <source>Save Report…</source>
        <translation>Bericht sichern …</translation>
    </message>
    <message>
        <source>One HTML page with everything</source>
        <translation>Eine HTML-Seite mit allem</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Weiter</translation>
    </message>
</context>
<context>
    <name>ghostlight::FitGhostModel</name>
    <message>
        <source>left out by you</source>
        <translation>von Ihnen ausgelassen</translation>
    </message>
    <message>
        <source>fitted</source>
        <translation>angepasst</translation>
    </message>
    <message>
        <source>not told from %1</source>
        <translation>nicht von %1 zu trennen</translation>
    </message>
    <message>
        <source>below the noise: at most %1</source>
        <translation>unter dem Rauschen: höchstens %1</translation>
    </message>
    <message>
        <source>not on the photographs</source>
        <translation>nicht auf den Aufnahmen</translation>
    </message>
</context>
<context>
    <name>ghostlight::FitGhostPage</name>
    <message>
        <source>Leave out</source>
        <translation>Auslassen</translation>
    </message>
    <message>
        <source>The chosen ghosts do not count</source>
        <translation>Die gewählten Reflexe zählen nicht</translation>
    </message>
    <message>
        <source>Use only these</source>
        <translation>Nur diese nehmen</translation>
    </message>
    <message>
        <source>The chosen ghosts alone count</source>
        <translation>Allein die gewählten Reflexe zählen</translation>
    </message>
    <message>
        <source>Use all</source>
        <translation>Alle nehmen</translation>
    </message>
    <message>
        <source>Every ghost counts</source>
        <translation>Jeder Reflex zählt</translation>
    </message>
    <message>
        <source>leave ghosts out of the fit</source>
        <translation>Reflexe aus der Anpassung lassen</translation>
    </message>
    <message>
        <source>use only some ghosts in the fit</source>
        <translation>nur einige Reflexe anpassen</translation>
    </message>
    <message>
        <source>use all ghosts in the fit</source>
        <translation>alle Reflexe anpassen</translation>
    </message>
    <message>
        <source>use ghost %1 in the fit</source>
        <translation>Reflex %1 anpassen</translation>
    </message>
    <message>
        <source>leave ghost %1 out of the fit</source>
        <translation>Reflex %1 aus der Anpassung lassen</translation>
    </message>
    <message>
        <source>%1 of %2 ghosts count.</source>
        <translation>%1 von %2 Reflexen zählen.</translation>
    </message>
    <message>
        <source> %1 below the noise were left out: signal to noise %2 at the start, all together.</source>
        <translation> %1 unter dem Rauschen wurden ausgelassen: Signal zu Rauschen %2 zu Beginn, alle zusammen.</translation>
    </message>
</context>
<context>
    <name>ghostlight::FitJob</name>
    <message>
        <source>reading the photographs</source>
        <translation>Aufnahmen werden gelesen</translation>
    </message>
</context>
<context>
    <name>ghostlight::FitPanel</name>
    <message>
        <source>failed</source>
        <translation>gescheitert</translation>
    </message>
    <message>
        <source>Save Report</source>
        <translation>Bericht sichern</translation>
    </message>
    <message>
        <source>HTML (*.html)</source>
        <translation>HTML (*.html)</translation>
    </message>
    <message>
        <source>paused</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>fitting</source>
        <translation>passt an</translation>
    </message>
    <message>
        <source>no photograph</source>
        <translation>keine Aufnahme</translation>
    </message>
    <message>
        <source>nothing varies</source>
        <translation>nichts variiert</translation>
    </message>
    <message>
        <source>ready</source>
        <translation>bereit</translation>
    </message>
    <message>
        <source>done in %1 s</source>
        <translation>fertig in %1 s</translation>
    </message>
    <message>
        <source>the lens does not explain the photographs</source>
        <translation>das Objektiv erklärt die Aufnahmen nicht</translation>
    </message>
    <message>
        <source>the lens was edited since the fit began; fit again</source>
        <translation>das Objektiv wurde seit Beginn der Anpassung geändert; neu anpassen</translation>
    </message>
    <message>
        <source>apply the fit</source>
        <translation>die Anpassung anwenden</translation>
    </message>
    <message>
        <source>Finds the coatings and elements that explain photographs of the lens&apos;s flare, and says how well each is known.</source>
        <translation>Findet die Vergütungen und Elemente, die Aufnahmen von Reflexen des Objektivs erklären, und sagt, wie gut jedes bekannt ist.</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Anpassung</translation>
    </message>
    <message>
        <source>what varies does not suit this lens</source>
        <translation>was variiert, passt nicht zu diesem Objektiv</translation>
    </message>
    <message>
        <source>reading the photographs</source>
        <translation>Aufnahmen werden gelesen</translation>
    </message>
    <message>
        <source>a photograph cannot be used</source>
        <translation>eine Aufnahme ist nicht zu brauchen</translation>
    </message>
    <message>
        <source>pausing after this step</source>
        <translation>Pause nach diesem Schritt</translation>
    </message>
    <message>
        <source>fitting: %1</source>
        <translation>passt an: %1</translation>
    </message>
    <message>
        <source>, %1</source>
        <translation>, %1</translation>
    </message>
    <message>
        <source>best so far kept, errors unknown</source>
        <translation>das Beste bis dahin behalten, Fehler unbekannt</translation>
    </message>
    <message>
        <source>nothing was found yet</source>
        <translation>noch nichts gefunden</translation>
    </message>
    <message>
        <source>stopping; %1</source>
        <translation>hält an; %1</translation>
    </message>
    <message>
        <source>stopped; %1</source>
        <translation>angehalten; %1</translation>
    </message>
    <message>
        <source>waiting for the last one to stop</source>
        <translation>wartet, bis die vorige angehalten hat</translation>
    </message>
    <message>
        <source>vary what is there</source>
        <translation>freizugeben, was da ist</translation>
    </message>
</context>
<context>
    <name>ghostlight::FitParameterModel</name>
    <message>
        <source>profile</source>
        <translation>Profil</translation>
    </message>
    <message>
        <source>%1: “%2” is not a number</source>
        <translation>%1: „%2“ ist keine Zahl</translation>
    </message>
    <message>
        <source>%1: bounds %2 … %3 do not hold the start %4</source>
        <translation>%1: die Grenzen %2 … %3 schließen den Beginn %4 nicht ein</translation>
    </message>
    <message>
        <source>%1: the prior needs a width above 0</source>
        <translation>%1: das Vorwissen braucht eine Breite über 0</translation>
    </message>
</context>
<context>
    <name>ghostlight::FitPhotoForm</name>
    <message>
        <source>%1 cannot be taken</source>
        <translation>%1 geht nicht</translation>
    </message>
    <message>
        <source>Width, mm</source>
        <translation>Breite, mm</translation>
    </message>
    <message>
        <source>Of the whole picture on the sensor, mm; give it where the file is a part of the sensor, or the camera&apos;s sensor is not the lens&apos;s</source>
        <translation>Des ganzen Bilds auf dem Sensor, mm; anzugeben, wo die Datei ein Teil des Sensors ist oder der Sensor der Kamera nicht der des Objektivs</translation>
    </message>
    <message>
        <source>the width</source>
        <translation>die Breite</translation>
    </message>
    <message>
        <source>mm above 0</source>
        <translation>mm über 0</translation>
    </message>
    <message>
        <source>change the photograph&apos;s width</source>
        <translation>Breite der Aufnahme ändern</translation>
    </message>
    <message>
        <source>Axis, px</source>
        <translation>Achse, px</translation>
    </message>
    <message>
        <source>X,Y of the lens&apos;s axis in the file, pixels from the upper left corner: the principal point</source>
        <translation>X,Y der Objektivachse in der Datei, Pixel von der oberen linken Ecke: der Hauptpunkt</translation>
    </message>
    <message>
        <source>move the photograph&apos;s axis</source>
        <translation>Achse der Aufnahme verschieben</translation>
    </message>
    <message>
        <source>Rotation, °</source>
        <translation>Drehung, °</translation>
    </message>
    <message>
        <source>Of the camera about the axis, degrees; what is left of it is fitted</source>
        <translation>Der Kamera um die Achse, Grad; was davon übrig ist, wird angepasst</translation>
    </message>
    <message>
        <source>the rotation</source>
        <translation>die Drehung</translation>
    </message>
    <message>
        <source>degrees from -180 to 180</source>
        <translation>Grad von -180 bis 180</translation>
    </message>
    <message>
        <source>turn the photograph</source>
        <translation>Aufnahme drehen</translation>
    </message>
    <message>
        <source>Crop, px</source>
        <translation>Ausschnitt, px</translation>
    </message>
    <message>
        <source>X,Y,WIDTH,HEIGHT of the part that counts, pixels from the upper left corner; or drag it in the picture with Crop</source>
        <translation>X,Y,BREITE,HÖHE des Teils, der zählt, Pixel von der oberen linken Ecke; oder im Bild mit Ausschnitt ziehen</translation>
    </message>
    <message>
        <source>crop the photograph</source>
        <translation>Aufnahme beschneiden</translation>
    </message>
    <message>
        <source>Noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>SHOT,READ: the variance of a value is SHOT × value + READ, 1 being full scale</source>
        <translation>SCHROT,LESE: die Varianz eines Werts ist SCHROT × Wert + LESE, 1 ist Vollausschlag</translation>
    </message>
    <message>
        <source>change the photograph&apos;s noise</source>
        <translation>Rauschen der Aufnahme ändern</translation>
    </message>
    <message>
        <source>Clips at</source>
        <translation>Gesättigt ab</translation>
    </message>
    <message>
        <source>Values from here on are clipped and do not count; 1 is full scale</source>
        <translation>Werte von hier an sind gesättigt und zählen nicht; 1 ist Vollausschlag</translation>
    </message>
    <message>
        <source>the saturation</source>
        <translation>die Sättigung</translation>
    </message>
    <message>
        <source>a value above 0</source>
        <translation>ein Wert über 0</translation>
    </message>
    <message>
        <source>change where the photograph clips</source>
        <translation>Sättigung der Aufnahme ändern</translation>
    </message>
    <message>
        <source>Mask file</source>
        <translation>Maskendatei</translation>
    </message>
    <message>
        <source>A picture of the photograph&apos;s shape, bright where not to look</source>
        <translation>Ein Bild von der Form der Aufnahme, hell, wo nicht hinzusehen ist</translation>
    </message>
    <message>
        <source>change the photograph&apos;s mask</source>
        <translation>Maske der Aufnahme ändern</translation>
    </message>
    <message>
        <source>Choose…</source>
        <translation>Wählen …</translation>
    </message>
    <message>
        <source>Choose the mask&apos;s file</source>
        <translation>Die Datei der Maske wählen</translation>
    </message>
    <message>
        <source>Mask</source>
        <translation>Maske</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>all</source>
        <translation>alles</translation>
    </message>
    <message>
        <source>the middle</source>
        <translation>die Mitte</translation>
    </message>
    <message>
        <source>0</source>
        <translation>0</translation>
    </message>
    <message>
        <source>%1, the sensor&apos;s</source>
        <translation>%1, die des Sensors</translation>
    </message>
    <message>
        <source>%1,%2 %3</source>
        <translation>%1,%2 %3</translation>
    </message>
    <message>
        <source>estimated</source>
        <translation>geschätzt</translation>
    </message>
    <message>
        <source>by the file</source>
        <translation>nach der Datei</translation>
    </message>
    <message>
        <source>by the file, or estimated</source>
        <translation>nach der Datei, oder geschätzt</translation>
    </message>
    <message>
        <source>as the file has it</source>
        <translation>wie in der Datei</translation>
    </message>
    <message>
        <source>nothing is clipped</source>
        <translation>nichts ist gesättigt</translation>
    </message>
</context>
<context>
    <name>ghostlight::FitPhotographs</name>
    <message>
        <source>Photographs (%1);;All files (*)</source>
        <translation>Aufnahmen (%1);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>place the photograph&apos;s light</source>
        <translation>Licht der Aufnahme setzen</translation>
    </message>
    <message>
        <source>mask a region</source>
        <translation>eine Stelle maskieren</translation>
    </message>
    <message>
        <source>take a masked region away</source>
        <translation>eine maskierte Stelle wegnehmen</translation>
    </message>
    <message>
        <source>crop the photograph</source>
        <translation>Aufnahme beschneiden</translation>
    </message>
    <message>
        <source>take the crop away</source>
        <translation>den Ausschnitt wegnehmen</translation>
    </message>
    <message>
        <source>The photograph that is shown; the fit takes all of them</source>
        <translation>Die gezeigte Aufnahme; die Anpassung nimmt alle</translation>
    </message>
    <message>
        <source>Add…</source>
        <translation>Hinzufügen …</translation>
    </message>
    <message>
        <source>Add photographs: EXR, TIFF, PNG, JPEG or camera RAW</source>
        <translation>Aufnahmen hinzufügen: EXR, TIFF, PNG, JPEG oder RAW der Kamera</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Take this photograph out of the fit</source>
        <translation>Diese Aufnahme aus der Anpassung nehmen</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Aufnahmen</translation>
    </message>
    <message>
        <source>remove a photograph</source>
        <translation>eine Aufnahme entfernen</translation>
    </message>
    <message>
        <source>Photograph</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>The file</source>
        <translation>Die Datei</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>What the lens makes, as far as the fit has come</source>
        <translation>Was das Objektiv macht, so weit die Anpassung ist</translation>
    </message>
    <message>
        <source>Overlay</source>
        <translation>Überlagert</translation>
    </message>
    <message>
        <source>Half the photograph, half the model</source>
        <translation>Halb die Aufnahme, halb das Modell</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>Differenz</translation>
    </message>
    <message>
        <source>Residuals: red where the model is too bright, blue where it is too dark; full at 5 σ</source>
        <translation>Reste: rot, wo das Modell zu hell ist, blau, wo zu dunkel; voll bei 5 σ</translation>
    </message>
    <message>
        <source>Blink</source>
        <translation>Wechsel</translation>
    </message>
    <message>
        <source>Photograph and model in turn</source>
        <translation>Aufnahme und Modell abwechselnd</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Licht</translation>
    </message>
    <message>
        <source>Click where the light is</source>
        <translation>Anklicken, wo das Licht ist</translation>
    </message>
    <message>
        <source>Box</source>
        <translation>Kasten</translation>
    </message>
    <message>
        <source>Drag boxes over what is not to count</source>
        <translation>Kästen über das ziehen, was nicht zählen soll</translation>
    </message>
    <message>
        <source>Lasso</source>
        <translation>Lasso</translation>
    </message>
    <message>
        <source>Draw around what is not to count</source>
        <translation>Um das herum zeichnen, was nicht zählen soll</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>Pinsel</translation>
    </message>
    <message>
        <source>Paint over what is not to count</source>
        <translation>Über das malen, was nicht zählen soll</translation>
    </message>
    <message>
        <source>Erase</source>
        <translation>Löschen</translation>
    </message>
    <message>
        <source>Click a painted region to take it away</source>
        <translation>Eine gemalte Stelle anklicken, um sie wegzunehmen</translation>
    </message>
    <message>
        <source>Crop</source>
        <translation>Ausschnitt</translation>
    </message>
    <message>
        <source>Drag over what is to count; a click: all</source>
        <translation>Über das ziehen, was zählen soll; ein Klick: alles</translation>
    </message>
    <message>
        <source>Diameter of the brush, pixels of the file</source>
        <translation>Durchmesser des Pinsels, Pixel der Datei</translation>
    </message>
    <message>
        <source>Mask</source>
        <translation>Maske</translation>
    </message>
    <message>
        <source>Show what does not count: amber painted, blue about the light, red clipped or hot, dark outside of the crop</source>
        <translation>Zeigen, was nicht zählt: bernstein gemalt, blau um das Licht, rot gesättigt oder heiß, dunkel außerhalb des Ausschnitts</translation>
    </message>
    <message>
        <source>Where the light is: auto, X,Y in pixels from the upper left corner, or deg:FIELD:AZIMUTH; or click it in the photograph</source>
        <translation>Wo das Licht ist: auto, X,Y in Pixeln von der oberen linken Ecke, oder deg:FELD:AZIMUT; oder in der Aufnahme anklicken</translation>
    </message>
    <message>
        <source>Find</source>
        <translation>Suchen</translation>
    </message>
    <message>
        <source>The middle of the largest bright patch</source>
        <translation>Die Mitte des größten hellen Flecks</translation>
    </message>
    <message>
        <source>Details</source>
        <translation>Mehr</translation>
    </message>
    <message>
        <source>Where the photograph lies on the sensor, its noise, where it clips, a mask from a file</source>
        <translation>Wo die Aufnahme auf dem Sensor liegt, ihr Rauschen, wo sie gesättigt ist, eine Maske aus einer Datei</translation>
    </message>
    <message>
        <source>find the photograph&apos;s light</source>
        <translation>Licht der Aufnahme suchen</translation>
    </message>
    <message>
        <source>add a photograph</source>
        <translation>eine Aufnahme hinzufügen</translation>
    </message>
    <message>
        <source>add photographs</source>
        <translation>Aufnahmen hinzufügen</translation>
    </message>
    <message>
        <source>reading…</source>
        <translation>wird gelesen …</translation>
    </message>
    <message>
        <source>Add a photograph with a bright light in or near the frame.</source>
        <translation>Eine Aufnahme mit einem hellen Licht im Bild oder nahe daran hinzufügen.</translation>
    </message>
    <message>
        <source>light at %1°</source>
        <translation>Licht bei %1°</translation>
    </message>
</context>
<context>
    <name>ghostlight::FitPictureView</name>
    <message>
        <source>The model&apos;s picture comes with the fit&apos;s first step.</source>
        <translation>Das Bild des Modells kommt mit dem ersten Schritt der Anpassung.</translation>
    </message>
    <message>
        <source>model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>photograph</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Click where the light is</source>
        <translation>Anklicken, wo das Licht ist</translation>
    </message>
    <message>
        <source>Drag over what is not to count</source>
        <translation>Über das ziehen, was nicht zählen soll</translation>
    </message>
    <message>
        <source>Draw around what is not to count</source>
        <translation>Um das herum zeichnen, was nicht zählen soll</translation>
    </message>
    <message>
        <source>Paint over what is not to count</source>
        <translation>Über das malen, was nicht zählen soll</translation>
    </message>
    <message>
        <source>Click a painted region to take it away</source>
        <translation>Eine gemalte Stelle anklicken, um sie wegzunehmen</translation>
    </message>
    <message>
        <source>Drag over what is to count; a click: all</source>
        <translation>Über das ziehen, was zählen soll; ein Klick: alles</translation>
    </message>
</context>
<context>
    <name>ghostlight::FitProfilePage</name>
    <message>
        <source>Choose numbers and press Profile, or ask for a bootstrap, before the fit starts.</source>
        <translation>Zahlen wählen und Profil drücken, oder einen Bootstrap verlangen, bevor die Anpassung beginnt.</translation>
    </message>
    <message>
        <source>%1 to %2 %3</source>
        <translation>%1 bis %2 %3</translation>
    </message>
    <message>
        <source>By its standard error: %1.</source>
        <translation>Nach ihrem Standardfehler: %1.</translation>
    </message>
    <message>
        <source>value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>value, %1</source>
        <translation>Wert, %1</translation>
    </message>
    <message>
        <source>χ² above the fit&apos;s</source>
        <translation>χ² über dem der Anpassung</translation>
    </message>
    <message>
        <source>by its standard error</source>
        <translation>nach ihrem Standardfehler</translation>
    </message>
    <message>
        <source>95 %</source>
        <translation>95 %</translation>
    </message>
    <message>
        <source>profile</source>
        <translation>Profil</translation>
    </message>
    <message>
        <source>By its profile: %1.</source>
        <translation>Nach ihrem Profil: %1.</translation>
    </message>
    <message>
        <source>By the bootstrap: %1, mean %2 ± %3.</source>
        <translation>Nach dem Bootstrap: %1, Mittel %2 ± %3.</translation>
    </message>
    <message>
        <source>95 % interval. %1</source>
        <translation>95-%-Intervall. %1</translation>
    </message>
</context>
<context>
    <name>ghostlight::FitResults</name>
    <message>
        <source>iteration</source>
        <translation>Schritt</translation>
    </message>
    <message>
        <source>cost</source>
        <translation>Kosten</translation>
    </message>
    <message>
        <source>The verdict, and what is not determined; after a fit.</source>
        <translation>Das Urteil, und was nicht bestimmt ist; nach einer Anpassung.</translation>
    </message>
    <message>
        <source>wavelength, nm</source>
        <translation>Wellenlänge, nm</translation>
    </message>
    <message>
        <source>R, %</source>
        <translation>R, %</translation>
    </message>
    <message>
        <source>Cost</source>
        <translation>Kosten</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Reflectances</source>
        <translation>Reflexionsgrade</translation>
    </message>
    <message>
        <source>Correlations</source>
        <translation>Korrelationen</translation>
    </message>
    <message>
        <source>each</source>
        <translation>jede</translation>
    </message>
    <message>
        <source>best so far</source>
        <translation>beste bisher</translation>
    </message>
    <message>
        <source>Surface %1</source>
        <translation>Fläche %1</translation>
    </message>
    <message>
        <source>Surface %1, normal incidence</source>
        <translation>Fläche %1, senkrechter Einfall</translation>
    </message>
    <message>
        <source>start</source>
        <translation>Beginn</translation>
    </message>
    <message>
        <source>fitted, 95 %</source>
        <translation>angepasst, 95 %</translation>
    </message>
    <message>
        <source>Determined:</source>
        <translation>Bestimmt:</translation>
    </message>
    <message>
        <source>Weakly known:</source>
        <translation>Schwach bekannt:</translation>
    </message>
    <message>
        <source>Known by their priors alone:</source>
        <translation>Allein durch Vorwissen bekannt:</translation>
    </message>
    <message>
        <source>Held, as no visible ghost feels them:</source>
        <translation>Festgehalten, da kein sichtbarer Reflex sie spürt:</translation>
    </message>
    <message>
        <source>At a bound:</source>
        <translation>An einer Grenze:</translation>
    </message>
    <message>
        <source>%1 (%2 %)</source>
        <translation>%1 (%2 %)</translation>
    </message>
    <message>
        <source>Kinds of coating on surface %1, by their odds:</source>
        <translation>Arten der Vergütung auf Fläche %1, nach ihren Chancen:</translation>
    </message>
    <message>
        <source>&lt;p&gt;&lt;span style=&quot;color:%1&quot;&gt;Combinations that the photographs do not determine, and their width over the prior&apos;s:&lt;/span&gt;&lt;/p&gt;&lt;ul&gt;</source>
        <translation>&lt;p&gt;&lt;span style=&quot;color:%1&quot;&gt;Kombinationen, die die Aufnahmen nicht bestimmen, und ihre Breite über der des Vorwissens:&lt;/span&gt;&lt;/p&gt;&lt;ul&gt;</translation>
    </message>
    <message>
        <source>%1 for %2 residuals; %3 % of the photograph explained (%4 % at the start), %5 % outliers, errors widened × %6</source>
        <translation>%1 bei %2 Resten; %3 % der Aufnahme erklärt (%4 % zu Beginn), %5 % Ausreißer, Fehler erweitert × %6</translation>
    </message>
    <message>
        <source>The photograph that would help most:</source>
        <translation>Die Aufnahme, die am meisten helfen würde:</translation>
    </message>
    <message>
        <source>light at %1°: %2 from ± %3 to ± %4 %5</source>
        <translation>Licht bei %1°: %2 von ± %3 auf ± %4 %5</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>%1 s, %2 iterations</source>
        <translation>%1 s, %2 Schritte</translation>
    </message>
    <message>
        <source>Profiles</source>
        <translation>Profile</translation>
    </message>
    <message>
        <source>Intervals by profile likelihood and bootstrap</source>
        <translation>Intervalle nach Profil-Likelihood und Bootstrap</translation>
    </message>
</context>
<context>
    <name>ghostlight::FitVariables</name>
    <message>
        <source>What varies</source>
        <translation>Was variiert</translation>
    </message>
    <message>
        <source>Ghosts</source>
        <translation>Reflexe</translation>
    </message>
    <message>
        <source>Which ghosts count, and what the fit made of each</source>
        <translation>Welche Reflexe zählen, und was die Anpassung aus jedem machte</translation>
    </message>
    <message>
        <source>change what a fit varies</source>
        <translation>ändern, was eine Anpassung variiert</translation>
    </message>
    <message>
        <source>All coatings</source>
        <translation>Alle Vergütungen</translation>
    </message>
    <message>
        <source>Vary the centre wavelength, or the constant reflectance, of every coated surface</source>
        <translation>Die mittlere Wellenlänge, oder den festen Reflexionsgrad, jeder vergüteten Fläche variieren</translation>
    </message>
    <message>
        <source>Marked</source>
        <translation>Markierte</translation>
    </message>
    <message>
        <source>Vary what is marked V in the prescription (Ctrl+M there)</source>
        <translation>Variieren, was in den Objektivdaten mit V markiert ist (dort Strg+M)</translation>
    </message>
    <message>
        <source>KIND@ROWS[=LOWER..UPPER][~PRIOR]; KIND: center, thickness, layer.N, layer-index.N, reflectance, radius, gap, index, semi-diameter, and stop-size, stop-x, stop-y, stop-rotation without rows; ROWS: 3, 2+5 (one common value), all</source>
        <translation>ART@ZEILEN[=UNTEN..OBEN][~VORWISSEN]; ART: center, thickness, layer.N, layer-index.N, reflectance, radius, gap, index, semi-diameter, und stop-size, stop-x, stop-y, stop-rotation ohne Zeilen; ZEILEN: 3, 2+5 (ein gemeinsamer Wert), all</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Hinzufügen</translation>
    </message>
    <message>
        <source>Vary this too</source>
        <translation>Auch das variieren</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Take the chosen rows out</source>
        <translation>Die gewählten Zeilen herausnehmen</translation>
    </message>
    <message>
        <source>Profile</source>
        <translation>Profil</translation>
    </message>
    <message>
        <source>How χ² rises as the chosen numbers move, all others fitted to each: intervals that need not be symmetric; takes longer. Again: not any more</source>
        <translation>Wie χ² steigt, wenn sich die gewählten Zahlen bewegen und alle anderen jeweils angepasst werden: Intervalle, die nicht symmetrisch sein müssen; dauert länger. Nochmals: nicht mehr</translation>
    </message>
    <message>
        <source>vary %1</source>
        <translation>%1 variieren</translation>
    </message>
    <message>
        <source>vary less</source>
        <translation>weniger variieren</translation>
    </message>
    <message>
        <source>Of the light: D65, A, E, LED, sodium, 3200 K, 550 nm …</source>
        <translation>Des Lichts: D65, A, E, LED, sodium, 3200 K, 550 nm …</translation>
    </message>
    <message>
        <source>How far samples count that the model cannot explain, such as dust or a lamp beside it</source>
        <translation>Wie viel Stichproben zählen, die das Modell nicht erklären kann, etwa Staub oder eine Lampe daneben</translation>
    </message>
    <message>
        <source>Least squares</source>
        <translation>Kleinste Quadrate</translation>
    </message>
    <message>
        <source>Every sample counts by its square</source>
        <translation>Jede Stichprobe zählt mit ihrem Quadrat</translation>
    </message>
    <message>
        <source>Huber</source>
        <translation>Huber</translation>
    </message>
    <message>
        <source>Linear beyond the scale</source>
        <translation>Linear jenseits der Skala</translation>
    </message>
    <message>
        <source>Cauchy</source>
        <translation>Cauchy</translation>
    </message>
    <message>
        <source>Logarithmic beyond the scale</source>
        <translation>Logarithmisch jenseits der Skala</translation>
    </message>
    <message>
        <source>Tukey</source>
        <translation>Tukey</translation>
    </message>
    <message>
        <source>Nothing beyond the scale</source>
        <translation>Nichts jenseits der Skala</translation>
    </message>
    <message>
        <source>The loss&apos;s scale, standard deviations of a sample</source>
        <translation>Die Skala der Verlustfunktion, Standardabweichungen einer Stichprobe</translation>
    </message>
    <message>
        <source>Exposures of one scene</source>
        <translation>Belichtungen einer Szene</translation>
    </message>
    <message>
        <source>Merge the photographs by their exposure times before the fit, each value weighted by the inverse of its variance</source>
        <translation>Die Aufnahmen vor der Anpassung nach ihren Belichtungszeiten vereinen, jeder Wert mit dem Kehrwert seiner Varianz gewichtet</translation>
    </message>
    <message>
        <source>Suggest the next</source>
        <translation>Nächste vorschlagen</translation>
    </message>
    <message>
        <source>Which photograph would help most: tries other angles of the light in the model; takes longer</source>
        <translation>Welche Aufnahme am meisten helfen würde: versucht andere Winkel des Lichts im Modell; dauert länger</translation>
    </message>
    <message>
        <source>Spectrum</source>
        <translation>Spektrum</translation>
    </message>
    <message>
        <source>Loss</source>
        <translation>Verlust</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keiner</translation>
    </message>
    <message>
        <source>Fits to so many photographs drawn from the fitted model and its errors; takes longer</source>
        <translation>Anpassungen an so viele Aufnahmen, gezogen aus dem angepassten Modell und seinen Fehlern; dauert länger</translation>
    </message>
    <message>
        <source>Bootstrap</source>
        <translation>Bootstrap</translation>
    </message>
    <message>
        <source>change the fit&apos;s bootstrap</source>
        <translation>Bootstrap der Anpassung ändern</translation>
    </message>
    <message>
        <source>change the fit&apos;s spectrum</source>
        <translation>Spektrum der Anpassung ändern</translation>
    </message>
    <message>
        <source>change the fit&apos;s loss</source>
        <translation>Verlustfunktion der Anpassung ändern</translation>
    </message>
    <message>
        <source>change the loss&apos;s scale</source>
        <translation>Skala der Verlustfunktion ändern</translation>
    </message>
    <message>
        <source>the loss&apos;s scale cannot be taken</source>
        <translation>diese Skala der Verlustfunktion geht nicht</translation>
    </message>
    <message>
        <source>standard deviations above 0</source>
        <translation>Standardabweichungen über 0</translation>
    </message>
    <message>
        <source>merge exposures</source>
        <translation>Belichtungen vereinen</translation>
    </message>
    <message>
        <source>keep exposures apart</source>
        <translation>Belichtungen getrennt lassen</translation>
    </message>
    <message>
        <source>suggest photographs</source>
        <translation>Aufnahmen vorschlagen</translation>
    </message>
    <message>
        <source>suggest no photographs</source>
        <translation>keine Aufnahmen vorschlagen</translation>
    </message>
    <message>
        <source>no surface of this lens has a quarter-wave layer or a constant reflectance; vary thickness@all of layer stacks, or coat it first</source>
        <translation>keine Fläche dieses Objektivs hat eine Viertelwellenschicht oder einen festen Reflexionsgrad; bei Schichtstapeln thickness@all variieren, oder erst vergüten</translation>
    </message>
    <message>
        <source>vary all coatings</source>
        <translation>alle Vergütungen variieren</translation>
    </message>
    <message>
        <source>nothing is marked; choose a cell of the prescription and press Ctrl+M</source>
        <translation>nichts ist markiert; eine Zelle der Objektivdaten wählen und Strg+M drücken</translation>
    </message>
    <message>
        <source>vary what is marked</source>
        <translation>variieren, was markiert ist</translation>
    </message>
    <message>
        <source>want no profile</source>
        <translation>kein Profil verlangen</translation>
    </message>
    <message>
        <source>want a profile</source>
        <translation>ein Profil verlangen</translation>
    </message>
    <message>
        <source>as listed; or none, qw:550, v-coat</source>
        <translation>wie aufgeführt; oder none, qw:550, v-coat</translation>
    </message>
    <message>
        <source>Kinds of coating to choose from on each surface, besides the listed one: none, qw:NM[:INDEX], names of the coating library, separated by commas; takes longer</source>
        <translation>Vergütungsarten, aus denen außer der aufgeführten auf jeder Fläche gewählt wird: none, qw:NM[:INDEX], Namen der Vergütungsbibliothek, durch Kommas getrennt; dauert länger</translation>
    </message>
    <message>
        <source>all varied</source>
        <translation>alle freigegebenen</translation>
    </message>
    <message>
        <source>Surfaces whose kind is chosen, separated by commas; empty: those whose coating is varied</source>
        <translation>Flächen, deren Art gewählt wird, durch Kommas getrennt; leer: die, deren Vergütung freigegeben ist</translation>
    </message>
    <message>
        <source>Kinds of coating</source>
        <translation>Vergütungsarten</translation>
    </message>
    <message>
        <source>on surfaces</source>
        <translation>auf den Flächen</translation>
    </message>
    <message>
        <source>change kinds of coating</source>
        <translation>Vergütungsarten ändern</translation>
    </message>
    <message>
        <source>change where kinds are chosen</source>
        <translation>ändern, wo Arten gewählt werden</translation>
    </message>
</context>
<context>
    <name>ghostlight::FlarePanel</name>
    <message>
        <source>Flare</source>
        <translation>Reflexbild</translation>
    </message>
    <message>
        <source>exposure %1 EV · sRGB · drag the light</source>
        <translation>Belichtung %1 EV · sRGB · Licht ziehen</translation>
    </message>
</context>
<context>
    <name>ghostlight::FlareView</name>
    <message>
        <source>drawn without OpenGL: %1</source>
        <translation>ohne OpenGL gezeichnet: %1</translation>
    </message>
    <message>
        <source>Tracing the first picture…</source>
        <translation>Das erste Bild wird verfolgt …</translation>
    </message>
    <message>
        <source>No flare yet: the lens cannot be traced as it stands.
It appears once what is wrong is mended.</source>
        <translation>Noch kein Reflexbild: das Objektiv lässt sich so nicht verfolgen.
Es erscheint, sobald der Fehler behoben ist.</translation>
    </message>
    <message>
        <source>The flare appears here.
Open a lens file, or drop one on the window.</source>
        <translation>Hier erscheint das Reflexbild.
Eine Objektivdatei öffnen, oder eine auf das Fenster ziehen.</translation>
    </message>
</context>
<context>
    <name>ghostlight::GhostMatrix</name>
    <message>
        <source>Ghosts by their two surfaces</source>
        <translation>Reflexe nach ihren beiden Flächen</translation>
    </message>
    <message>
        <source>second reflection →   (rows: first reflection)</source>
        <translation>zweite Spiegelung →   (Zeilen: erste Spiegelung)</translation>
    </message>
    <message>
        <source>%1 · %2 mm² · %3 % on the sensor</source>
        <translation>%1 · %2 mm² · %3 % auf dem Sensor</translation>
    </message>
</context>
<context>
    <name>ghostlight::GhostPanel</name>
    <message>
        <source>The lens&apos;s ghosts, the strongest first: flux, peak, place and size on the sensor.</source>
        <translation>Die Reflexe des Objektivs, der stärkste zuerst: Fluss, Spitze, Ort und Größe auf dem Sensor.</translation>
    </message>
    <message>
        <source>Ghosts</source>
        <translation>Reflexe</translation>
    </message>
    <message>
        <source>Open a lens…</source>
        <translation>Ein Objektiv öffnen …</translation>
    </message>
    <message>
        <source>Tracing the lens&apos;s ghosts…</source>
        <translation>Die Reflexe des Objektivs werden verfolgt …</translation>
    </message>
    <message>
        <source>No ghosts yet: the lens cannot be traced as it stands.</source>
        <translation>Noch keine Reflexe: das Objektiv lässt sich so nicht verfolgen.</translation>
    </message>
    <message>
        <source>Table</source>
        <translation>Tabelle</translation>
    </message>
    <message>
        <source>Matrix</source>
        <translation>Matrix</translation>
    </message>
    <message>
        <source>Surfaces</source>
        <translation>Flächen</translation>
    </message>
    <message>
        <source>Filter, e.g. touches 7</source>
        <translation>Filter, z. B. touches 7</translation>
    </message>
    <message>
        <source>Which ghosts are listed, in words:
touches surface 7
focus within 5 mm of the sensor
above 1e-6   (flux, mm²)
below 1 % of the strongest
on sensor above 50 %
RMS below 2 mm
5-3
joined by &apos;and&apos; or a comma, &apos;or&apos;, and &apos;not&apos;. Also: relative, peak, x, y, R1, R2, angle 1, angle 2, width, height, area</source>
        <translation>Welche Reflexe aufgeführt werden, in englischen Worten:
touches surface 7
focus within 5 mm of the sensor
above 1e-6   (Fluss, mm²)
below 1 % of the strongest
on sensor above 50 %
RMS below 2 mm
5-3
verbunden durch &apos;and&apos; oder ein Komma, &apos;or&apos; und &apos;not&apos;. Auch: relative, peak, x, y, R1, R2, angle 1, angle 2, width, height, area</translation>
    </message>
    <message>
        <source>Filter of ghosts</source>
        <translation>Filter der Reflexe</translation>
    </message>
    <message>
        <source>Columns</source>
        <translation>Spalten</translation>
    </message>
    <message>
        <source>Choose the table&apos;s columns</source>
        <translation>Die Spalten der Tabelle wählen</translation>
    </message>
    <message>
        <source>%1: expected %2</source>
        <translation>%1: erwartet %2</translation>
    </message>
    <message>
        <source>The Usual Ones</source>
        <translation>Die üblichen</translation>
    </message>
    <message>
        <source>tracing %1 %</source>
        <translation>Verfolgung %1 %</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source> · by %1 %2</source>
        <translation> · nach %1 %2</translation>
    </message>
    <message>
        <source> · refining %1 %</source>
        <translation> · verfeinert %1 %</translation>
    </message>
    <message>
        <source> · refining</source>
        <translation> · verfeinert</translation>
    </message>
    <message>
        <source> · of the last lens that could be traced</source>
        <translation> · des letzten Objektivs, das sich verfolgen ließ</translation>
    </message>
    <message>
        <source> · without the stop&apos;s dirt</source>
        <translation> · ohne den Schmutz der Blende</translation>
    </message>
    <message>
        <source>Ghosts are listed, and but for those near focus drawn, as through a clean stop: what its
dirt takes of one depends on where its beam meets the stop. Of the direct light the Stop
panel says how much passes; three crossings take about three times as much as one.</source>
        <translation>Geisterbilder sind wie durch eine saubere Blende aufgeführt und, außer nahe dem Fokus, gezeichnet:
Was ihr Schmutz einem nimmt, hängt davon ab, wo sein Bündel die Blende trifft. Wie viel vom direkten
Licht durchgeht, sagt das Blendenfeld; drei Durchgänge nehmen etwa dreimal so viel wie einer.</translation>
    </message>
</context>
<context>
    <name>ghostlight::GhostTableModel</name>
    <message>
        <source>Bar</source>
        <translation>Balken</translation>
    </message>
    <message>
        <source>
The tolerance was not reached.</source>
        <translation>
Die Toleranz wurde nicht erreicht.</translation>
    </message>
</context>
<context>
    <name>ghostlight::GlView</name>
    <message>
        <source>no OpenGL can be had here</source>
        <translation>hier ist kein OpenGL zu haben</translation>
    </message>
    <message>
        <source>OpenGL cannot be started here</source>
        <translation>OpenGL lässt sich hier nicht starten</translation>
    </message>
    <message>
        <source>OpenGL is too old here: found %1.%2, expected 3.2 or newer</source>
        <translation>OpenGL ist hier zu alt: gefunden %1.%2, erwartet 3.2 oder neuer</translation>
    </message>
</context>
<context>
    <name>ghostlight::GlassFoldersDialog</name>
    <message numerus="yes">
        <source>%n catalogue(s) with %1 glasses in these folders; %2 more are bundled.</source>
        <translation>
            <numerusform>%n Katalog mit %1 Gläsern in diesen Ordnern; %2 weitere liegen bei.</numerusform>
            <numerusform>%n Kataloge mit %1 Gläsern in diesen Ordnern; %2 weitere liegen bei.</numerusform>
        </translation>
    </message>
    <message>
        <source>… and %1 more</source>
        <translation>… und %1 weitere</translation>
    </message>
    <message>
        <source>Glass folders</source>
        <translation>Glasordner</translation>
    </message>
    <message>
        <source>Glasses are looked up in these folders first, in this order: AGF catalogues, and files of refractiveindex.info. The bundled catalogues follow.</source>
        <translation>Gläser werden zuerst in diesen Ordnern nachgeschlagen, in dieser Reihenfolge: AGF-Kataloge und Dateien von refractiveindex.info. Die beiliegenden Kataloge folgen.</translation>
    </message>
    <message>
        <source>Add folder…</source>
        <translation>Ordner hinzufügen …</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Folder with glass catalogues</source>
        <translation>Ordner mit Glaskatalogen</translation>
    </message>
</context>
<context>
    <name>ghostlight::GlassPanel</name>
    <message>
        <source>Glasses</source>
        <translation>Gläser</translation>
    </message>
    <message>
        <source>Use</source>
        <translation>Nehmen</translation>
    </message>
    <message>
        <source>Put the chosen glass behind the surface in hand</source>
        <translation>Das gewählte Glas hinter die gewählte Fläche setzen</translation>
    </message>
    <message>
        <source>Replace by Nearest</source>
        <translation>Durch nächstes ersetzen</translation>
    </message>
    <message>
        <source>Put the catalogues&apos; nearest glass, by nd and Vd, behind the surface in hand</source>
        <translation>Das nach nd und Vd nächste Glas der Kataloge hinter die gewählte Fläche setzen</translation>
    </message>
    <message>
        <source>Name, code 517642, or nd / Vd</source>
        <translation>Name, Code 517642, oder nd / Vd</translation>
    </message>
    <message>
        <source>Search glasses</source>
        <translation>Gläser suchen</translation>
    </message>
    <message>
        <source>Part of a name (bk7), a six-digit code (517642), or a place (1.62 / 36.4), whose nearest
glasses come first</source>
        <translation>Teil eines Namens (bk7), ein sechsstelliger Code (517642), oder ein Ort (1.62 / 36.4), dessen nächste
Gläser zuerst kommen</translation>
    </message>
    <message>
        <source>Glass</source>
        <translation>Glas</translation>
    </message>
    <message>
        <source>Catalogue</source>
        <translation>Katalog</translation>
    </message>
    <message>
        <source>Index at the d line, 587.56 nm</source>
        <translation>Brechzahl bei der d-Linie, 587.56 nm</translation>
    </message>
    <message>
        <source>Abbe number (nd − 1)/(nF − nC)</source>
        <translation>Abbe-Zahl (nd − 1)/(nF − nC)</translation>
    </message>
    <message>
        <source>Partial dispersion (ng − nF)/(nF − nC)</source>
        <translation>Teildispersion (ng − nF)/(nF − nC)</translation>
    </message>
    <message>
        <source>PgF off the normal line 0.6438 − 0.001682 Vd: what apochromats are made with</source>
        <translation>Abweichung von der Normalgeraden 0.6438 − 0.001682 Vd: womit Apochromate gemacht werden</translation>
    </message>
    <message>
        <source>nothing found</source>
        <translation>nichts gefunden</translation>
    </message>
    <message numerus="yes">
        <source>%n glass(es)</source>
        <translation>
            <numerusform>%n Glas</numerusform>
            <numerusform>%n Gläser</numerusform>
        </translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>Behind surface %1: %2</source>
        <translation>Hinter Fläche %1: %2</translation>
    </message>
    <message>
        <source>Choose a surface in the prescription</source>
        <translation>Eine Fläche in den Objektivdaten wählen</translation>
    </message>
    <message>
        <source>Choose the surface in the prescription first.</source>
        <translation>Zuerst die Fläche in den Objektivdaten wählen.</translation>
    </message>
    <message>
        <source>put %1 behind surface %2</source>
        <translation>%1 hinter Fläche %2 setzen</translation>
    </message>
</context>
<context>
    <name>ghostlight::HelpWindow</name>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Forth</source>
        <translation>Vor</translation>
    </message>
    <message>
        <source>User guide</source>
        <translation>Handbuch</translation>
    </message>
    <message>
        <source>The guide&apos;s beginning</source>
        <translation>Der Anfang des Handbuchs</translation>
    </message>
</context>
<context>
    <name>ghostlight::ImportReportPanel</name>
    <message>
        <source>What became of each line of a lens file from another program: read, converted, assumed or left out, and whether it matters for flare.</source>
        <translation>Was aus jeder Zeile einer Objektivdatei eines anderen Programms wurde: gelesen, gewandelt, angenommen oder ausgelassen, und ob es für Reflexe wesentlich ist.</translation>
    </message>
    <message>
        <source>Import report</source>
        <translation>Importbericht</translation>
    </message>
    <message>
        <source>Open a lens…</source>
        <translation>Ein Objektiv öffnen …</translation>
    </message>
    <message>
        <source>%1 holds all of the lens.</source>
        <translation>%1 enthält das ganze Objektiv.</translation>
    </message>
    <message>
        <source>This lens has no file yet.</source>
        <translation>Dieses Objektiv hat noch keine Datei.</translation>
    </message>
    <message>
        <source>%1 was read without a remark.</source>
        <translation>%1 wurde ohne Bemerkung gelesen.</translation>
    </message>
    <message numerus="yes">
        <source>Nothing here matters for flare. %n line(s) more.</source>
        <translation>
            <numerusform>Nichts hier ist für Reflexe wesentlich. %n weitere Zeile.</numerusform>
            <numerusform>Nichts hier ist für Reflexe wesentlich. %n weitere Zeilen.</numerusform>
        </translation>
    </message>
    <message>
        <source>export to %1</source>
        <translation>Export nach %1</translation>
    </message>
    <message>
        <source>%1 to mend</source>
        <translation>%1 zu ersetzen</translation>
    </message>
    <message>
        <source>%1 of %2 matter for flare</source>
        <translation>%1 von %2 sind für Reflexe wesentlich</translation>
    </message>
    <message>
        <source>only these shown</source>
        <translation>nur diese gezeigt</translation>
    </message>
</context>
<context>
    <name>ghostlight::LayersStrip</name>
    <message>
        <source>Ghosts</source>
        <translation>Reflexe</translation>
    </message>
    <message>
        <source>Light that was reflected between surfaces.</source>
        <translation>Licht, das zwischen Flächen gespiegelt wurde.</translation>
    </message>
    <message>
        <source>Starburst</source>
        <translation>Blendenstern</translation>
    </message>
    <message>
        <source>The direct image, spread by diffraction at the stop.</source>
        <translation>Das direkte Bild, von der Beugung an der Blende verbreitert.</translation>
    </message>
    <message>
        <source>Veil</source>
        <translation>Schleier</translation>
    </message>
    <message>
        <source>Ghosts folded away and light scattered by the lens; both are set in the Light panel.</source>
        <translation>Zusammengefasste Reflexe und vom Objektiv gestreutes Licht; beides wird im Feld Licht eingestellt.</translation>
    </message>
    <message>
        <source>Backdrop</source>
        <translation>Hintergrund</translation>
    </message>
    <message>
        <source>A picture behind the flare. Its white is a white surface in the sun.</source>
        <translation>Ein Bild hinter den Reflexen. Sein Weiß ist eine weiße Fläche in der Sonne.</translation>
    </message>
    <message>
        <source>Gains and switches that have no room here</source>
        <translation>Stärken und Schalter, die hier keinen Platz haben</translation>
    </message>
    <message>
        <source>A picture behind the flare</source>
        <translation>Ein Bild hinter den Reflexen</translation>
    </message>
    <message>
        <source>Pictures (*.exr *.hdr *.png *.jpg *.jpeg *.tif *.tiff);;All files (*)</source>
        <translation>Bilder (*.exr *.hdr *.png *.jpg *.jpeg *.tif *.tiff);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Gain of the layer %1, −40 to +40 EV. Wheel or arrows: half a stop.</source>
        <translation>Stärke der Ebene %1, −40 bis +40 EV. Rad oder Pfeile: eine halbe Stufe.</translation>
    </message>
    <message>
        <source>Back to 0 EV</source>
        <translation>Zurück auf 0 EV</translation>
    </message>
    <message>
        <source>Show this layer alone; again for all</source>
        <translation>Nur diese Ebene zeigen; nochmals: alle</translation>
    </message>
    <message>
        <source>Diffraction at the ghosts&apos; rims, where its fringes are a pixel wide or more; at rest</source>
        <translation>Beugung an den Rändern der Reflexe, wo ihre Streifen ein Pixel breit sind oder mehr; in Ruhe</translation>
    </message>
    <message>
        <source>ring the ghosts&apos; rims</source>
        <translation>Ränder der Reflexe beugen</translation>
    </message>
    <message>
        <source>leave rims sharp</source>
        <translation>Ränder scharf lassen</translation>
    </message>
    <message>
        <source>show a layer alone</source>
        <translation>nur eine Ebene zeigen</translation>
    </message>
    <message>
        <source>a gain: found &apos;%1&apos;, expected stops from −40 to 40</source>
        <translation>eine Stärke: gefunden &apos;%1&apos;, erwartet Stufen von −40 bis 40</translation>
    </message>
    <message>
        <source>show a layer</source>
        <translation>Ebene zeigen</translation>
    </message>
    <message>
        <source>hide a layer</source>
        <translation>Ebene ausblenden</translation>
    </message>
    <message>
        <source>change the gain of a layer</source>
        <translation>Stärke einer Ebene ändern</translation>
    </message>
    <message>
        <source>Half a Stop Brighter</source>
        <translation>Eine halbe Stufe heller</translation>
    </message>
    <message>
        <source>Half a Stop Darker</source>
        <translation>Eine halbe Stufe dunkler</translation>
    </message>
    <message>
        <source>This Layer Alone</source>
        <translation>Nur diese Ebene</translation>
    </message>
    <message>
        <source>Ringing</source>
        <translation>Ringe</translation>
    </message>
    <message>
        <source>Shown</source>
        <translation>Gezeigt</translation>
    </message>
</context>
<context>
    <name>ghostlight::LayoutPanel</name>
    <message>
        <source>surface %1 · stop</source>
        <translation>Fläche %1 · Blende</translation>
    </message>
    <message>
        <source>%1 · radius %2 mm</source>
        <translation>%1 · Radius %2 mm</translation>
    </message>
    <message>
        <source>surface %1 · plane</source>
        <translation>Fläche %1 · eben</translation>
    </message>
    <message>
        <source>surface %1 · R %2 mm</source>
        <translation>Fläche %1 · R %2 mm</translation>
    </message>
    <message>
        <source> · asphere</source>
        <translation> · Asphäre</translation>
    </message>
    <message>
        <source> · air after</source>
        <translation> · dahinter Luft</translation>
    </message>
    <message>
        <source>Layout</source>
        <translation>Schnitt</translation>
    </message>
    <message>
        <source>Walks the light along its way: how far it has come</source>
        <translation>Führt das Licht seinen Weg entlang: wie weit es gekommen ist</translation>
    </message>
    <message>
        <source>How far the light has come</source>
        <translation>Wie weit das Licht gekommen ist</translation>
    </message>
    <message>
        <source>direct light at %1°</source>
        <translation>direktes Licht bei %1°</translation>
    </message>
    <message>
        <source>The lens is drawn here in section.
Open a lens file, or drop one on the window.</source>
        <translation>Hier wird das Objektiv im Schnitt gezeichnet.
Eine Objektivdatei öffnen, oder eine auf das Fenster ziehen.</translation>
    </message>
    <message>
        <source>no rays: %1</source>
        <translation>keine Strahlen: %1</translation>
    </message>
    <message>
        <source>%1 · %2 rays</source>
        <translation>%1 · %2 Strahlen</translation>
    </message>
    <message>
        <source>%1 · no ray passes</source>
        <translation>%1 · kein Strahl geht durch</translation>
    </message>
    <message>
        <source>ghost %1</source>
        <translation>Reflex %1</translation>
    </message>
    <message>
        <source>%1 ghosts</source>
        <translation>%1 Reflexe</translation>
    </message>
    <message>
        <source>%1 · no ray of this plane reaches the sensor</source>
        <translation>%1 · kein Strahl dieser Ebene erreicht den Sensor</translation>
    </message>
    <message>
        <source>%1 · %2 rays · faint on their way in, full between the reflections</source>
        <translation>%1 · %2 Strahlen · blass auf dem Weg hinein, kräftig zwischen den Spiegelungen</translation>
    </message>
    <message>
        <source>%1 · %2 rays · legs: </source>
        <translation>%1 · %2 Strahlen · Wege: </translation>
    </message>
    <message>
        <source>in</source>
        <translation>hinein</translation>
    </message>
    <message>
        <source>between</source>
        <translation>dazwischen</translation>
    </message>
    <message>
        <source>out</source>
        <translation>hinaus</translation>
    </message>
</context>
<context>
    <name>ghostlight::LensGallery</name>
    <message>
        <source>Bundled lenses</source>
        <translation>Beiliegende Objektive</translation>
    </message>
    <message>
        <source>drawing…</source>
        <translation>wird gezeichnet …</translation>
    </message>
</context>
<context>
    <name>ghostlight::LightPanel</name>
    <message>
        <source>+ Add</source>
        <translation>+ Neu</translation>
    </message>
    <message>
        <source>Another light like this one, 5° further up</source>
        <translation>Ein weiteres Licht wie dieses, 5° weiter oben</translation>
    </message>
    <message>
        <source>− Remove</source>
        <translation>− Weg</translation>
    </message>
    <message>
        <source>Take this light away</source>
        <translation>Dieses Licht wegnehmen</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Licht</translation>
    </message>
    <message>
        <source>From %1 to %2%3. Wheel or arrows: %4.</source>
        <translation>Von %1 bis %2%3. Rad oder Pfeile: %4.</translation>
    </message>
    <message>
        <source>Back to %1%2</source>
        <translation>Zurück auf %1%2</translation>
    </message>
    <message>
        <source>%1: found &apos;%2&apos;, expected %3 to %4%5</source>
        <translation>%1: gefunden &apos;%2&apos;, erwartet %3 bis %4%5</translation>
    </message>
    <message>
        <source>change %1</source>
        <translation>%1 ändern</translation>
    </message>
    <message>
        <source>Back to %1</source>
        <translation>Zurück auf %1</translation>
    </message>
    <message>
        <source>Lights</source>
        <translation>Lichter</translation>
    </message>
    <message>
        <source>Lights of the scene. The chosen one is what the ghost table, the rays and the scene bar are about.</source>
        <translation>Lichter der Szene. Um das gewählte geht es in der Reflextabelle, bei den Strahlen und in der Szenenleiste.</translation>
    </message>
    <message>
        <source>choose another light</source>
        <translation>anderes Licht wählen</translation>
    </message>
    <message>
        <source>switch a light</source>
        <translation>Licht schalten</translation>
    </message>
    <message>
        <source>Chosen light</source>
        <translation>Gewähltes Licht</translation>
    </message>
    <message>
        <source>Field</source>
        <translation>Feldwinkel</translation>
    </message>
    <message>
        <source>Angle from the axis.</source>
        <translation>Winkel zur Achse.</translation>
    </message>
    <message>
        <source>Azimuth</source>
        <translation>Azimut</translation>
    </message>
    <message>
        <source>Direction about the axis; 90° is upright.</source>
        <translation>Richtung um die Achse; 90° ist aufrecht.</translation>
    </message>
    <message>
        <source>Spectrum</source>
        <translation>Spektrum</translation>
    </message>
    <message>
        <source>D65, A, E, LED-B3, sodium, a black body (5500 K), one wavelength (587.5618 nm), or a table (the name of a .csv file with wavelength and power)</source>
        <translation>D65, A, E, LED-B3, sodium, ein schwarzer Körper (5500 K), eine Wellenlänge (587.5618 nm), oder eine Tabelle (der Name einer .csv-Datei mit Wellenlänge und Leistung)</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>point, sun (a disc of 0.533°), disc DEG, or picture FILE DEG (its width), up to 20°</source>
        <translation>point, sun (eine Scheibe von 0.533°), disc GRAD, oder picture DATEI GRAD (ihre Breite), bis 20°</translation>
    </message>
    <message>
        <source>Intensity</source>
        <translation>Stärke</translation>
    </message>
    <message>
        <source>Stops over the irradiance E0 that pictures are relative to.</source>
        <translation>Blendenstufen über der Bestrahlungsstärke E0, auf die sich Bilder beziehen.</translation>
    </message>
    <message>
        <source>Veil</source>
        <translation>Schleier</translation>
    </message>
    <message>
        <source>Folded ghosts</source>
        <translation>Zusammengefasste</translation>
    </message>
    <message>
        <source>Ghosts of the least irradiance go into the veil, up to this share of the ghosts&apos; light, while the layer Veil is on.</source>
        <translation>Reflexe der geringsten Bestrahlungsstärke gehen in den Schleier, bis zu diesem Anteil ihres Lichts, solange die Ebene Schleier an ist.</translation>
    </message>
    <message>
        <source>Kernel</source>
        <translation>Kern</translation>
    </message>
    <message>
        <source>What stands for a folded ghost</source>
        <translation>Was für einen zusammengefassten Reflex steht</translation>
    </message>
    <message>
        <source>Scattered light</source>
        <translation>Streulicht</translation>
    </message>
    <message>
        <source>Share of the direct light that the lens scatters about its image. Dust and age decide it, not the prescription.</source>
        <translation>Anteil des direkten Lichts, den das Objektiv um dessen Bild streut. Staub und Alter bestimmen ihn, nicht die Objektivdaten.</translation>
    </message>
    <message>
        <source>Falls as r^−</source>
        <translation>Fällt wie r^−</translation>
    </message>
    <message>
        <source>Power of the distance far from the image.</source>
        <translation>Potenz des Abstands fern vom Bild.</translation>
    </message>
    <message>
        <source>Core</source>
        <translation>Kern</translation>
    </message>
    <message>
        <source>Where the power law begins.</source>
        <translation>Wo das Potenzgesetz beginnt.</translation>
    </message>
    <message>
        <source>Artistic</source>
        <translation>Künstlerisch</translation>
    </message>
    <message>
        <source>All ghosts</source>
        <translation>Alle Reflexe</translation>
    </message>
    <message>
        <source>Stops on top of what is physical.</source>
        <translation>Blendenstufen über das Physikalische hinaus.</translation>
    </message>
    <message>
        <source>Jitter</source>
        <translation>Unruhe</translation>
    </message>
    <message>
        <source>Every ghost moved by a normal deviate of this size.</source>
        <translation>Jeder Reflex um eine normalverteilte Zahl dieser Größe verschoben.</translation>
    </message>
    <message>
        <source>Seed</source>
        <translation>Startzahl</translation>
    </message>
    <message>
        <source>Another seed, another jitter.</source>
        <translation>Eine andere Startzahl, eine andere Unruhe.</translation>
    </message>
    <message>
        <source>Chosen ghosts</source>
        <translation>Gewählte Reflexe</translation>
    </message>
    <message>
        <source>drawn</source>
        <translation>gezeichnet</translation>
    </message>
    <message>
        <source>Draw the ghosts that are chosen in the table</source>
        <translation>Die in der Tabelle gewählten Reflexe zeichnen</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>switch ghosts</source>
        <translation>Reflexe schalten</translation>
    </message>
    <message>
        <source>Of the ghosts that are chosen in the table.</source>
        <translation>Der Reflexe, die in der Tabelle gewählt sind.</translation>
    </message>
    <message>
        <source>Gain</source>
        <translation>Stärke</translation>
    </message>
    <message>
        <source>Tint, red</source>
        <translation>Ton, rot</translation>
    </message>
    <message>
        <source>Tint, green</source>
        <translation>Ton, grün</translation>
    </message>
    <message>
        <source>Tint, blue</source>
        <translation>Ton, blau</translation>
    </message>
    <message>
        <source>Offset, x</source>
        <translation>Versatz, x</translation>
    </message>
    <message>
        <source>Offset, y</source>
        <translation>Versatz, y</translation>
    </message>
    <message>
        <source>↺ All neutral</source>
        <translation>↺ Alles neutral</translation>
    </message>
    <message>
        <source>Take back every artistic change</source>
        <translation>Alle künstlerischen Änderungen zurücknehmen</translation>
    </message>
    <message>
        <source>take back artistic changes</source>
        <translation>künstlerische Änderungen zurücknehmen</translation>
    </message>
    <message>
        <source>add a light</source>
        <translation>Licht hinzufügen</translation>
    </message>
    <message>
        <source>remove a light</source>
        <translation>Licht entfernen</translation>
    </message>
    <message>
        <source>Choose ghosts in the table first</source>
        <translation>Zuerst Reflexe in der Tabelle wählen</translation>
    </message>
</context>
<context>
    <name>ghostlight::LinePlot</name>
    <message>
        <source>nothing yet</source>
        <translation>noch nichts</translation>
    </message>
</context>
<context>
    <name>ghostlight::MainWindow</name>
    <message>
        <source>Coating</source>
        <translation>Vergütung</translation>
    </message>
    <message>
        <source>Configurations</source>
        <translation>Konfigurationen</translation>
    </message>
    <message>
        <source>Glasses</source>
        <translation>Gläser</translation>
    </message>
    <message>
        <source>Keyboard</source>
        <translation>Tastatur</translation>
    </message>
    <message>
        <source>About Ghostlight</source>
        <translation>Über Ghostlight</translation>
    </message>
    <message>
        <source>The light</source>
        <translation>Das Licht</translation>
    </message>
    <message>
        <source>Drag in the picture to move the light; the ring shows where it is. The flare, the rays and the table follow. The wheel changes the exposure.</source>
        <translation>Im Bild ziehen bewegt das Licht; der Ring zeigt, wo es ist. Reflexbild, Strahlen und Tabelle folgen. Das Rad ändert die Belichtung.</translation>
    </message>
    <message>
        <source>The table</source>
        <translation>Die Tabelle</translation>
    </message>
    <message>
        <source>Each row is one ghost: light reflected at two surfaces. Click one, and its rays appear in the layout and its light in the picture.</source>
        <translation>Jede Zeile ist ein Reflex: Licht, das an zwei Flächen gespiegelt wird. Ein Klick, und seine Strahlen erscheinen im Schnitt und sein Licht im Bild.</translation>
    </message>
    <message>
        <source>The coating</source>
        <translation>Die Vergütung</translation>
    </message>
    <message>
        <source>Double-click a coating in the prescription and type another, such as “none” or “MgF2 λ/4 550”: the ghosts of that surface change at once. Ctrl+Z takes it back.</source>
        <translation>Eine Vergütung in den Objektivdaten doppelt anklicken und eine andere tippen, etwa „none“ oder „MgF2 λ/4 550“: die Reflexe dieser Fläche ändern sich sofort. Strg+Z nimmt es zurück.</translation>
    </message>
    <message>
        <source>The processor draws everything: %1. Nothing is missing, but pictures are slower.</source>
        <translation>Der Prozessor zeichnet alles: %1. Es fehlt nichts, aber Bilder sind langsamer.</translation>
    </message>
    <message>
        <source>The user guide, docs/user-guide.md, is not installed here.</source>
        <translation>Das Handbuch, docs/user-guide.md, ist hier nicht installiert.</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Anpassung</translation>
    </message>
    <message>
        <source>Accuracy</source>
        <translation>Genauigkeit</translation>
    </message>
    <message>
        <source>Drag to move the panel, double-click to float it, right-click to close</source>
        <translation>Ziehen verschiebt das Feld, Doppelklick löst es ab, Rechtsklick schließt es</translation>
    </message>
    <message>
        <source>Prescription</source>
        <translation>Objektivdaten</translation>
    </message>
    <message>
        <source>Layout</source>
        <translation>Schnitt</translation>
    </message>
    <message>
        <source>Ghosts</source>
        <translation>Reflexe</translation>
    </message>
    <message>
        <source>First order</source>
        <translation>Paraxial</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Blende</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Licht</translation>
    </message>
    <message>
        <source>Import report</source>
        <translation>Importbericht</translation>
    </message>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Datei</translation>
    </message>
    <message>
        <source>Open &amp;Bundled</source>
        <translation>&amp;Beiliegendes öffnen</translation>
    </message>
    <message>
        <source>Open &amp;Recent</source>
        <translation>&amp;Zuletzt benutzte öffnen</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>&amp;Bearbeiten</translation>
    </message>
    <message>
        <source>&amp;Ghosts</source>
        <translation>&amp;Reflexe</translation>
    </message>
    <message>
        <source>&amp;Compare</source>
        <translation>&amp;Vergleichen</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ansicht</translation>
    </message>
    <message>
        <source>&amp;Flare</source>
        <translation>&amp;Reflexbild</translation>
    </message>
    <message>
        <source>La&amp;yout</source>
        <translation>&amp;Schnitt</translation>
    </message>
    <message>
        <source>&amp;Draw Flares With</source>
        <translation>Reflexbilder &amp;zeichnen mit</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>&amp;Hilfe</translation>
    </message>
    <message>
        <source>move the light</source>
        <translation>Licht bewegen</translation>
    </message>
    <message>
        <source>&amp;Undo %1</source>
        <translation>&amp;Rückgängig: %1</translation>
    </message>
    <message>
        <source>&amp;Redo %1</source>
        <translation>&amp;Wiederholen: %1</translation>
    </message>
    <message>
        <source>let glasses absorb</source>
        <translation>Gläser absorbieren lassen</translation>
    </message>
    <message>
        <source>make glass lossless</source>
        <translation>Glas verlustfrei machen</translation>
    </message>
    <message>
        <source>No glass of this lens has a table of internal transmittance: open it with a catalogue (AGF) that has one</source>
        <translation>Kein Glas dieses Objektivs hat eine Tabelle der Reintransmission: mit einem Katalog (AGF) öffnen, der sie hat</translation>
    </message>
    <message>
        <source>Unsaved edits of %1 from %2 were found.</source>
        <translation>Ungesicherte Änderungen von %1 vom %2 wurden gefunden.</translation>
    </message>
    <message>
        <source>Recover</source>
        <translation>Wiederherstellen</translation>
    </message>
    <message>
        <source> Flare and ghosts follow once it is mended.</source>
        <translation> Reflexbild und Tabelle folgen, sobald es ersetzt ist.</translation>
    </message>
    <message>
        <source>Choose a glass…</source>
        <translation>Ein Glas wählen …</translation>
    </message>
</context>
<context>
    <name>ghostlight::NoteTableModel</name>
    <message>
        <source>mend</source>
        <translation>ersetzen</translation>
    </message>
    <message>
        <source>matters</source>
        <translation>wesentlich</translation>
    </message>
</context>
<context>
    <name>ghostlight::NumberField</name>
    <message>
        <source>
Drag its name sideways to change it.</source>
        <translation>
Den Namen seitwärts ziehen ändert den Wert.</translation>
    </message>
</context>
<context>
    <name>ghostlight::NumberHandle</name>
    <message>
        <source>Drag sideways to change the number; with Shift finely</source>
        <translation>Seitwärts ziehen ändert die Zahl; mit Umschalt fein</translation>
    </message>
    <message>
        <source>Drag to change the number of the cell in hand: the flare follows. It springs back to
the middle, and the drag is one step of the history. Arrow keys go by a hundredth.</source>
        <translation>Ziehen ändert die Zahl der gewählten Zelle: das Reflexbild folgt. Er springt zur Mitte
zurück, und das Ziehen ist ein Schritt der Geschichte. Pfeiltasten gehen um ein Hundertstel.</translation>
    </message>
    <message>
        <source>Number of the cell in hand</source>
        <translation>Zahl der gewählten Zelle</translation>
    </message>
    <message>
        <source>Value of the cell in hand</source>
        <translation>Wert der gewählten Zelle</translation>
    </message>
    <message>
        <source>Which number of the cell</source>
        <translation>Welche Zahl der Zelle</translation>
    </message>
    <message>
        <source>No number in this cell</source>
        <translation>Keine Zahl in dieser Zelle</translation>
    </message>
    <message>
        <source>No cell in hand</source>
        <translation>Keine Zelle gewählt</translation>
    </message>
    <message>
        <source>Surface %1</source>
        <translation>Fläche %1</translation>
    </message>
    <message>
        <source>%1 of surface %2</source>
        <translation>%1 von Fläche %2</translation>
    </message>
    <message>
        <source>a number</source>
        <translation>eine Zahl</translation>
    </message>
</context>
<context>
    <name>ghostlight::PagedPanel</name>
    <message>
        <source>Open a lens…</source>
        <translation>Ein Objektiv öffnen …</translation>
    </message>
</context>
<context>
    <name>ghostlight::PlanPage</name>
    <message>
        <source>nothing</source>
        <translation>nichts</translation>
    </message>
    <message>
        <source>Measure the true error</source>
        <translation>Den wahren Fehler messen</translation>
    </message>
    <message>
        <source>Not computed</source>
        <translation>Nicht berechnet</translation>
    </message>
    <message>
        <source>Ghosts</source>
        <translation>Reflexe</translation>
    </message>
    <message>
        <source>Known</source>
        <translation>Bekannt</translation>
    </message>
    <message>
        <source>Why</source>
        <translation>Warum</translation>
    </message>
    <message>
        <source>Draws the reference to a tenth of the picture&apos;s tolerance; takes from seconds to minutes</source>
        <translation>Zeichnet die Referenz auf ein Zehntel der Toleranz des Bilds; dauert Sekunden bis Minuten</translation>
    </message>
    <message>
        <source>proven</source>
        <translation>bewiesen</translation>
    </message>
    <message>
        <source>estimated</source>
        <translation>geschätzt</translation>
    </message>
    <message>
        <source>Measuring against the reference, %1 %</source>
        <translation>Wird gegen die Referenz gemessen, %1 %</translation>
    </message>
    <message>
        <source>All of these: at most %1.</source>
        <translation>Alles zusammen: höchstens %1.</translation>
    </message>
    <message>
        <source> The true error is %1, by a reference whose two samplings differ by %2.</source>
        <translation> Der wahre Fehler ist %1, nach einer Referenz, deren zwei Abtastungen sich um %2 unterscheiden.</translation>
    </message>
    <message>
        <source>Changes</source>
        <translation>Ändert</translation>
    </message>
    <message>
        <source>What it can change of the picture: L1 over the light on the sensor. ≤ at most, by a proof; ≈ by the plan&apos;s own estimate, good to a factor of two</source>
        <translation>Was es am Bild ändern kann: L1 über dem Licht auf dem Sensor. ≤ höchstens, bewiesen; ≈ nach der Schätzung des Plans selbst, auf einen Faktor zwei gut</translation>
    </message>
    <message>
        <source>All of these: at most %1 proven, and about %2 estimated (good to a factor of two).</source>
        <translation>Alles zusammen: höchstens %1 bewiesen, und etwa %2 geschätzt (auf einen Faktor zwei gut).</translation>
    </message>
    <message>
        <source>All of these: about %1, estimated (good to a factor of two).</source>
        <translation>Alles zusammen: etwa %1, geschätzt (auf einen Faktor zwei gut).</translation>
    </message>
    <message>
        <source> Rows with – are not in it.</source>
        <translation> Zeilen mit – sind nicht darin.</translation>
    </message>
</context>
<context>
    <name>ghostlight::PrescriptionModel</name>
    <message>
        <source>change %1 of surface %2</source>
        <translation>%1 von Fläche %2 ändern</translation>
    </message>
    <message>
        <source>%1Variable in a fit</source>
        <translation>%1Variabel in einer Anpassung</translation>
    </message>
    <message>
        <source>insert surface %1</source>
        <translation>Fläche %1 einfügen</translation>
    </message>
    <message>
        <source>delete surface %1</source>
        <translation>Fläche %1 löschen</translation>
    </message>
    <message>
        <source>move surface %1</source>
        <translation>Fläche %1 verschieben</translation>
    </message>
    <message>
        <source>make surface %1 the stop</source>
        <translation>Fläche %1 zur Blende machen</translation>
    </message>
    <message>
        <source>reverse the lens</source>
        <translation>Objektiv umkehren</translation>
    </message>
    <message>
        <source>scale the lens by %1</source>
        <translation>Objektiv um %1 skalieren</translation>
    </message>
    <message>
        <source>mark as variable</source>
        <translation>als variabel markieren</translation>
    </message>
    <message>
        <source>mark as fixed</source>
        <translation>als fest markieren</translation>
    </message>
    <message>
        <source>give surface %1 a thickness of its own here</source>
        <translation>Fläche %1 hier eine eigene Dicke geben</translation>
    </message>
    <message>
        <source>take the thickness of surface %1 as listed</source>
        <translation>Dicke von Fläche %1 wie aufgeführt nehmen</translation>
    </message>
</context>
<context>
    <name>ghostlight::PrescriptionPanel</name>
    <message>
        <source>Prescription</source>
        <translation>Objektivdaten</translation>
    </message>
    <message>
        <source>The lens&apos;s surfaces: radii, thicknesses, glasses and coatings, to be edited here.</source>
        <translation>Die Flächen des Objektivs: Radien, Dicken, Gläser und Vergütungen, hier zu bearbeiten.</translation>
    </message>
    <message>
        <source>Open a lens…</source>
        <translation>Ein Objektiv öffnen …</translation>
    </message>
    <message>
        <source>Nearest glasses:</source>
        <translation>Nächste Gläser:</translation>
    </message>
    <message numerus="yes">
        <source>%n glass(es) not known: mend here</source>
        <translation>
            <numerusform>%n Glas ist unbekannt: hier ersetzen</numerusform>
            <numerusform>%n Gläser sind unbekannt: hier ersetzen</numerusform>
        </translation>
    </message>
    <message>
        <source>mm · R &gt; 0: centre towards the sensor</source>
        <translation>mm · R &gt; 0: Mittelpunkt zum Sensor hin</translation>
    </message>
    <message numerus="yes">
        <source>paste %n cell(s)</source>
        <translation>
            <numerusform>%n Zelle einsetzen</numerusform>
            <numerusform>%n Zellen einsetzen</numerusform>
        </translation>
    </message>
    <message>
        <source>A fit varies radii, thicknesses, glasses, semi-diameters and coatings: choose such cells.</source>
        <translation>Eine Anpassung ändert Radien, Dicken, Gläser, Halbdurchmesser und Vergütungen: solche Zellen wählen.</translation>
    </message>
    <message>
        <source>size by the direct beam</source>
        <translation>Größe dem direkten Bündel überlassen</translation>
    </message>
</context>
<context>
    <name>ghostlight::QuantityModel</name>
    <message>
        <source>%1
In files: %2</source>
        <translation>%1
In Dateien: %2</translation>
    </message>
</context>
<context>
    <name>ghostlight::ScaleStrip</name>
    <message>
        <source>Scale</source>
        <translation>Skalieren</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Scale by</source>
        <translation>Skalieren um</translation>
    </message>
    <message>
        <source>Every length times this factor; arithmetic is taken: =50/43.2</source>
        <translation>Alle Längen mal diesem Faktor; auch gerechnet: =50/43.2</translation>
    </message>
    <message>
        <source>Scale to a focal length in mm</source>
        <translation>Auf eine Brennweite in mm skalieren</translation>
    </message>
    <message>
        <source>The focal length that the lens is to have, in mm</source>
        <translation>Die Brennweite, die das Objektiv haben soll, in mm</translation>
    </message>
    <message>
        <source>to EFL</source>
        <translation>auf Brennweite</translation>
    </message>
    <message>
        <source>a factor</source>
        <translation>ein Faktor</translation>
    </message>
    <message>
        <source>a factor above 0</source>
        <translation>ein Faktor über 0</translation>
    </message>
</context>
<context>
    <name>ghostlight::SceneBar</name>
    <message>
        <source>as listed</source>
        <translation>wie aufgeführt</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>Szene</translation>
    </message>
    <message>
        <source>Configuration</source>
        <translation>Konfiguration</translation>
    </message>
    <message>
        <source>Zoom or focus position</source>
        <translation>Zoom- oder Fokusstellung</translation>
    </message>
    <message>
        <source>F-number, set by the stop. Wheel or arrows: a third.</source>
        <translation>Blendenzahl, von der Blende bestimmt. Rad oder Pfeile: ein Drittel.</translation>
    </message>
    <message>
        <source>Field</source>
        <translation>Feldwinkel</translation>
    </message>
    <message>
        <source>Angle of the light from the axis. Wheel or arrows.</source>
        <translation>Winkel des Lichts zur Achse. Rad oder Pfeile.</translation>
    </message>
    <message>
        <source>Azimuth</source>
        <translation>Azimut</translation>
    </message>
    <message>
        <source>Direction of the light about the axis; 90° is the plane of the layout&apos;s drawing.</source>
        <translation>Richtung des Lichts um die Achse; 90° ist die Ebene des gezeichneten Schnitts.</translation>
    </message>
    <message>
        <source>Spectrum</source>
        <translation>Spektrum</translation>
    </message>
    <message>
        <source>Of the light: D65, A, E, LED-B3, sodium, a black body (5500 K), one wavelength (587.5618 nm) or a table (lamp.csv)</source>
        <translation>Des Lichts: D65, A, E, LED-B3, sodium, ein schwarzer Körper (5500 K), eine Wellenlänge (587.5618 nm) oder eine Tabelle (lamp.csv)</translation>
    </message>
    <message>
        <source>Table within</source>
        <translation>Tabelle auf</translation>
    </message>
    <message>
        <source>Each flux of the ghost table is refined until its own error estimate is below this share of it.</source>
        <translation>Jeder Lichtstrom der Reflextabelle wird verfeinert, bis sein geschätzter Fehler unter diesem Anteil liegt.</translation>
    </message>
    <message>
        <source>Flare within</source>
        <translation>Bild auf</translation>
    </message>
    <message>
        <source>The flare at rest is drawn with the least work that keeps its error below this share of its light (relative L1 over the sensor).</source>
        <translation>Das ruhende Reflexbild wird mit der wenigsten Arbeit gezeichnet, die seinen Fehler unter diesem Anteil seines Lichts hält (relatives L1 über den Sensor).</translation>
    </message>
    <message>
        <source>change field angle</source>
        <translation>Feldwinkel ändern</translation>
    </message>
    <message>
        <source>change azimuth</source>
        <translation>Azimut ändern</translation>
    </message>
    <message>
        <source>change f-number</source>
        <translation>Blendenzahl ändern</translation>
    </message>
    <message>
        <source>a field angle in degrees</source>
        <translation>ein Feldwinkel in Grad</translation>
    </message>
    <message>
        <source>the light must come from the front</source>
        <translation>das Licht muss von vorn kommen</translation>
    </message>
    <message>
        <source>a field angle below 90 degrees</source>
        <translation>ein Feldwinkel unter 90 Grad</translation>
    </message>
    <message>
        <source>an angle in degrees</source>
        <translation>ein Winkel in Grad</translation>
    </message>
    <message>
        <source>an f-number above 0</source>
        <translation>eine Blendenzahl über 0</translation>
    </message>
    <message>
        <source>change table tolerance</source>
        <translation>Toleranz der Tabelle ändern</translation>
    </message>
    <message>
        <source>change flare tolerance</source>
        <translation>Toleranz des Bilds ändern</translation>
    </message>
    <message>
        <source>change spectrum</source>
        <translation>Spektrum ändern</translation>
    </message>
    <message>
        <source>change configuration</source>
        <translation>Konfiguration ändern</translation>
    </message>
    <message>
        <source>per cent, from 0.001 to 50</source>
        <translation>Prozent, von 0.001 bis 50</translation>
    </message>
    <message>
        <source>out of range</source>
        <translation>außerhalb des Bereichs</translation>
    </message>
    <message>
        <source>No lens</source>
        <translation>Kein Objektiv</translation>
    </message>
</context>
<context>
    <name>ghostlight::StatusLine</name>
    <message>
        <source>From the last change to its first picture on screen: finding where ghosts enter and what may be
left out, tracing, rasterising, adding up, bringing to the screen; the rest is waiting</source>
        <translation>Von der letzten Änderung bis zu ihrem ersten Bild auf dem Schirm: finden, wo Reflexe eintreten und was
ausgelassen werden darf, Strahlen verfolgen, rastern, summieren, auf den Schirm bringen; der Rest ist Warten</translation>
    </message>
    <message numerus="yes">
        <source>*%n ghost(s)* · %1 rays · %2 s</source>
        <translation>
            <numerusform>*%n Reflex* · %1 Strahlen · %2 s</numerusform>
            <numerusform>*%n Reflexe* · %1 Strahlen · %2 s</numerusform>
        </translation>
    </message>
    <message>
        <source> · all within %1 %</source>
        <translation> · alle auf %1 %</translation>
    </message>
    <message>
        <source> · %1 above the tolerance</source>
        <translation> · %1 über der Toleranz</translation>
    </message>
    <message>
        <source>ghost table *%1 %*</source>
        <translation>Reflextabelle *%1 %*</translation>
    </message>
    <message>
        <source>first look, off by about *%1 %*</source>
        <translation>erster Blick, etwa *%1 %* daneben</translation>
    </message>
    <message>
        <source>Each ghost from a few rays about its own centre ray, to see something at once. The error is estimated from those rays; light that enters elsewhere is not in it.</source>
        <translation>Jeder Reflex aus wenigen Strahlen um seinen eigenen Mittelstrahl, um gleich etwas zu sehen. Der Fehler ist aus diesen Strahlen geschätzt; Licht, das anderswo eintritt, ist nicht darin.</translation>
    </message>
    <message>
        <source>bounds %1</source>
        <translation>Schranken %1</translation>
    </message>
    <message>
        <source>trace %1</source>
        <translation>Strahlen %1</translation>
    </message>
    <message>
        <source>raster %1</source>
        <translation>Raster %1</translation>
    </message>
    <message>
        <source>ringing %1</source>
        <translation>Ringe %1</translation>
    </message>
    <message>
        <source>compose %1</source>
        <translation>Summe %1</translation>
    </message>
    <message>
        <source>show %1</source>
        <translation>Anzeige %1</translation>
    </message>
    <message>
        <source>*%1 ms* </source>
        <translation>*%1 ms* </translation>
    </message>
    <message>
        <source>flare within *%1 %* · %2 of %3 ghosts drawn</source>
        <translation>Bild auf *%1 %* · %2 von %3 Reflexen gezeichnet</translation>
    </message>
    <message numerus="yes">
        <source> · %n in the veil</source>
        <translation>
            <numerusform> · %n im Schleier</numerusform>
            <numerusform> · %n im Schleier</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source> · %n left out ≤ %1 %</source>
        <translation>
            <numerusform> · %n ausgelassen ≤ %1 %</numerusform>
            <numerusform> · %n ausgelassen ≤ %1 %</numerusform>
        </translation>
    </message>
    <message>
        <source>Estimated error of the ghost layer, L1 over its light on the sensor (%1 % allowed).
%2 ghosts land beside the sensor, through %3 no ray was found to pass; %4 are left out, at most %5 % of the light.
Not modelled: light of four and more reflections, about %6 % of that of two (the surfaces taken as plane).</source>
        <translation>Geschätzter Fehler der Reflexe, L1 über ihr Licht auf dem Sensor (%1 % erlaubt).
%2 Reflexe landen neben dem Sensor, durch %3 geht kein gefundener Strahl; %4 sind ausgelassen, höchstens %5 % des Lichts.
Nicht gerechnet: Licht von vier und mehr Spiegelungen, etwa %6 % dessen von zweien (die Flächen als eben genommen).</translation>
    </message>
    <message numerus="yes">
        <source>CPU %1 · %n thread(s)</source>
        <translation>
            <numerusform>CPU %1 · %n Thread</numerusform>
            <numerusform>CPU %1 · %n Threads</numerusform>
        </translation>
    </message>
    <message>
        <source>What draws the flare</source>
        <translation>Was das Reflexbild zeichnet</translation>
    </message>
    <message>
        <source>What draws the flare. %1</source>
        <translation>Was das Reflexbild zeichnet. %1</translation>
    </message>
    <message>
        <source>OpenGL gave up, the CPU goes on: %1</source>
        <translation>OpenGL gab auf, der Prozessor macht weiter: %1</translation>
    </message>
    <message>
        <source>proving bounds</source>
        <translation>Schranken werden bewiesen</translation>
    </message>
    <message>
        <source> · proving on</source>
        <translation> · Beweis läuft weiter</translation>
    </message>
    <message>
        <source>Whether the search for where ghosts enter has missed light; stops when something changes</source>
        <translation>Ob die Suche danach, wo Reflexe eintreten, Licht übersah; endet, wenn sich etwas ändert</translation>
    </message>
    <message>
        <source>*bounds certified*</source>
        <translation>*Schranken bewiesen*</translation>
    </message>
    <message>
        <source>missed light ≤ *%1 %*</source>
        <translation>übersehenes Licht ≤ *%1 %*</translation>
    </message>
    <message>
        <source>bounds of %1 of %2 ghosts certified</source>
        <translation>Schranken von %1 der %2 Reflexe bewiesen</translation>
    </message>
    <message>
        <source>Proven by interval arithmetic in %1 s: outside of where ghosts are drawn, light on the sensor comes to at most %2 % of theirs.
The bound of %3 of %4 ghosts is within their share of 0.1 %; for the others more cells would be needed, which is no sign that anything was missed.</source>
        <translation>Mit Intervallrechnung in %1 s bewiesen: außerhalb dessen, wo Reflexe gezeichnet sind, erreicht Licht den Sensor mit höchstens %2 % des ihren.
Die Schranke von %3 der %4 Reflexe liegt in ihrem Anteil an 0.1 %; für die anderen wären mehr Zellen nötig, was kein Zeichen ist, dass etwas übersehen wurde.</translation>
    </message>
    <message>
        <source>*unsaved edits*</source>
        <translation>*ungesicherte Änderungen*</translation>
    </message>
    <message>
        <source>saved %1</source>
        <translation>gesichert %1</translation>
    </message>
    <message>
        <source>as on file</source>
        <translation>wie in der Datei</translation>
    </message>
    <message>
        <source>the stop has an image</source>
        <translation>die Blende hat ein Bild</translation>
    </message>
    <message>
        <source>the sensor reflects, and the light is not above or below the axis</source>
        <translation>der Sensor reflektiert, und das Licht steht nicht über oder unter der Achse</translation>
    </message>
    <message>
        <source>*uniform* method, error not estimated: %1</source>
        <translation>Verfahren *uniform*, Fehler nicht geschätzt: %1</translation>
    </message>
    <message>
        <source>Every ghost on an even grid, as fine as its map asks for. Only the planned method estimates the picture&apos;s error.</source>
        <translation>Jedes Geisterbild auf gleichmäßigem Gitter, so fein, wie seine Abbildung es verlangt. Nur das geplante Verfahren schätzt den Fehler des Bildes.</translation>
    </message>
</context>
<context>
    <name>ghostlight::StopPanel</name>
    <message>
        <source>The stop&apos;s blades, an image over its opening, dust and scratches, and the starburst they make.</source>
        <translation>Die Lamellen der Blende, ein Bild über ihrer Öffnung, Staub und Kratzer, und der Stern, den sie machen.</translation>
    </message>
    <message>
        <source>out of range</source>
        <translation>außerhalb des Bereichs</translation>
    </message>
    <message>
        <source>not a whole number</source>
        <translation>keine ganze Zahl</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Blende</translation>
    </message>
    <message>
        <source>Open a lens…</source>
        <translation>Ein Objektiv öffnen …</translation>
    </message>
    <message>
        <source>The opening, its right +x and its top +y</source>
        <translation>Die Öffnung, rechts +x und oben +y</translation>
    </message>
    <message>
        <source>Light on the axis as the opening diffracts it, in the middle sixth of the sensor&apos;s width</source>
        <translation>Licht auf der Achse, wie die Öffnung es beugt, im mittleren Sechstel der Sensorbreite</translation>
    </message>
    <message>
        <source>
Drag its name sideways to change it; arrow keys go by steps.</source>
        <translation>
Den Namen seitwärts ziehen ändert den Wert; Pfeiltasten gehen in Stufen.</translation>
    </message>
    <message>
        <source>Back to what it usually is</source>
        <translation>Zurück zum Üblichen</translation>
    </message>
    <message>
        <source>Reset %1</source>
        <translation>%1 zurücksetzen</translation>
    </message>
    <message>
        <source>reset the stop&apos;s %1</source>
        <translation>%1 der Blende zurücksetzen</translation>
    </message>
    <message>
        <source>an f-number above 0</source>
        <translation>eine Blendenzahl über 0</translation>
    </message>
    <message>
        <source>f-number</source>
        <translation>Blendenzahl</translation>
    </message>
    <message>
        <source>reset: fully open</source>
        <translation>zurück: ganz offen</translation>
    </message>
    <message>
        <source>How far the stop is closed, in this configuration.</source>
        <translation>Wie weit die Blende geschlossen ist, in dieser Konfiguration.</translation>
    </message>
    <message>
        <source>Blades</source>
        <translation>Lamellen</translation>
    </message>
    <message>
        <source>0 round, 3–1000</source>
        <translation>0 rund, 3–1000</translation>
    </message>
    <message>
        <source>Blades of the stop; 0 is a round one.</source>
        <translation>Lamellen der Blende; 0 ist eine runde.</translation>
    </message>
    <message>
        <source>0 (round), or 3 to 1000 blades</source>
        <translation>0 (rund), oder 3 bis 1000 Lamellen</translation>
    </message>
    <message>
        <source>not a usable number of blades</source>
        <translation>keine brauchbare Zahl von Lamellen</translation>
    </message>
    <message>
        <source>0 (round), or 3 to 1000</source>
        <translation>0 (rund), oder 3 bis 1000</translation>
    </message>
    <message>
        <source>Roundness</source>
        <translation>Rundung</translation>
    </message>
    <message>
        <source>0 straight – 1 round</source>
        <translation>0 gerade – 1 rund</translation>
    </message>
    <message>
        <source>Curvature of the blades: 0 straight edges, 1 the full circle.</source>
        <translation>Krümmung der Lamellen: 0 gerade Kanten, 1 der volle Kreis.</translation>
    </message>
    <message>
        <source>a roundness from 0 to 1</source>
        <translation>eine Rundung von 0 bis 1</translation>
    </message>
    <message>
        <source>Rotation</source>
        <translation>Drehung</translation>
    </message>
    <message>
        <source>Turns blades and image, counter-clockwise.</source>
        <translation>Dreht Lamellen und Bild, gegen den Uhrzeigersinn.</translation>
    </message>
    <message>
        <source>an angle in degrees</source>
        <translation>ein Winkel in Grad</translation>
    </message>
    <message>
        <source>a diameter in mm, 0.0001 to 10</source>
        <translation>ein Durchmesser in mm, 0.0001 bis 10</translation>
    </message>
    <message>
        <source>a width in mm, 0.0001 to 10</source>
        <translation>eine Breite in mm, 0.0001 bis 10</translation>
    </message>
    <message>
        <source>Dust</source>
        <translation>Staub</translation>
    </message>
    <message>
        <source>% of the stop, 0–50</source>
        <translation>% der Blende, 0–50</translation>
    </message>
    <message>
        <source>Share of the stop that opaque specks cover.</source>
        <translation>Anteil der Blende, den undurchsichtige Körner bedecken.</translation>
    </message>
    <message>
        <source>per cent, from 0 to 50</source>
        <translation>Prozent, von 0 bis 50</translation>
    </message>
    <message>
        <source>Specks from</source>
        <translation>Körner von</translation>
    </message>
    <message>
        <source>Diameter of the smallest speck.</source>
        <translation>Durchmesser des kleinsten Korns.</translation>
    </message>
    <message>
        <source>Specks to</source>
        <translation>Körner bis</translation>
    </message>
    <message>
        <source>Diameter of the largest speck.</source>
        <translation>Durchmesser des größten Korns.</translation>
    </message>
    <message>
        <source>Scratches</source>
        <translation>Kratzer</translation>
    </message>
    <message>
        <source>How many, each a tenth to the whole of the stop&apos;s radius long.</source>
        <translation>Wie viele, jeder ein Zehntel bis ganz so lang wie der Radius der Blende.</translation>
    </message>
    <message>
        <source>how many, 0 to 10000</source>
        <translation>wie viele, 0 bis 10000</translation>
    </message>
    <message>
        <source>Widths from</source>
        <translation>Breiten von</translation>
    </message>
    <message>
        <source>Width of the thinnest scratch.</source>
        <translation>Breite des dünnsten Kratzers.</translation>
    </message>
    <message>
        <source>Widths to</source>
        <translation>Breiten bis</translation>
    </message>
    <message>
        <source>Width of the widest scratch.</source>
        <translation>Breite des breitesten Kratzers.</translation>
    </message>
    <message>
        <source>Fingerprint</source>
        <translation>Fingerabdruck</translation>
    </message>
    <message>
        <source>% that its ridges take, 0–100</source>
        <translation>% von seinen Rillen geschluckt, 0–100</translation>
    </message>
    <message>
        <source>One print; its ridges take this share of the light.</source>
        <translation>Ein Abdruck; seine Rillen nehmen diesen Anteil des Lichts.</translation>
    </message>
    <message>
        <source>per cent, from 0 to 100</source>
        <translation>Prozent, von 0 bis 100</translation>
    </message>
    <message>
        <source>Seed</source>
        <translation>Startzahl</translation>
    </message>
    <message>
        <source>Another number scatters the same dirt otherwise.</source>
        <translation>Eine andere Zahl streut denselben Schmutz anders.</translation>
    </message>
    <message>
        <source>a whole number from 0 to 1000000000</source>
        <translation>eine ganze Zahl von 0 bis 1000000000</translation>
    </message>
    <message>
        <source>Image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>An image over the opening, white where it is open. Nothing: the blades alone.</source>
        <translation>Ein Bild über der Öffnung, weiß, wo sie offen ist. Nichts: die Lamellen allein.</translation>
    </message>
    <message>
        <source>Choose…</source>
        <translation>Wählen …</translation>
    </message>
    <message>
        <source>Image of the stop</source>
        <translation>Bild der Blende</translation>
    </message>
    <message>
        <source>Images (*.png *.tif *.tiff *.exr *.jpg *.jpeg *.bmp *.webp);;All files (*)</source>
        <translation>Bilder (*.png *.tif *.tiff *.exr *.jpg *.jpeg *.bmp *.webp);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>change the stop&apos;s %1</source>
        <translation>%1 der Blende ändern</translation>
    </message>
</context>
<context>
    <name>ghostlight::SurfaceSumsModel</name>
    <message>
        <source>sensor</source>
        <translation>Sensor</translation>
    </message>
</context>
<context>
    <name>ghostlight::SweepPanel</name>
    <message>
        <source>Sweep</source>
        <translation>Durchlauf</translation>
    </message>
    <message>
        <source>Run the number through its range; again to stop</source>
        <translation>Die Zahl durch ihren Bereich führen; nochmals: anhalten</translation>
    </message>
    <message>
        <source>Export CSV…</source>
        <translation>CSV exportieren …</translation>
    </message>
    <message>
        <source>Every ghost at every value, with where it is worst</source>
        <translation>Jeder Reflex bei jedem Wert, mit dem, wo er am schlimmsten ist</translation>
    </message>
    <message>
        <source>What runs: field, azimuth, f-number, position (of the zoom, from 1), or radius N,
curvature N, thickness N, semi-diameter N, coating N (a factor on its layers) of surface N</source>
        <translation>Was läuft: field, azimuth, f-number, position (des Zooms, ab 1), oder radius N,
curvature N, thickness N, semi-diameter N, coating N (ein Faktor auf die Schichten) von Fläche N</translation>
    </message>
    <message>
        <source>flux</source>
        <translation>Fluss</translation>
    </message>
    <message>
        <source>flux on sensor</source>
        <translation>Fluss auf Sensor</translation>
    </message>
    <message>
        <source>peak</source>
        <translation>Spitze</translation>
    </message>
    <message>
        <source>from</source>
        <translation>von</translation>
    </message>
    <message>
        <source>to</source>
        <translation>bis</translation>
    </message>
    <message>
        <source>points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>curves</source>
        <translation>Kurven</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is no number: expected where the range ends</source>
        <translation>&apos;%1&apos; ist keine Zahl: erwartet, wo der Bereich endet</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is no number: expected where the range begins</source>
        <translation>&apos;%1&apos; ist keine Zahl: erwartet, wo der Bereich beginnt</translation>
    </message>
    <message>
        <source>&apos;%1&apos; points: expected 2 to %2</source>
        <translation>&apos;%1&apos; Punkte: erwartet 2 bis %2</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>%1 · %2 points%3</source>
        <translation>%1 · %2 Punkte%3</translation>
    </message>
    <message>
        <source> · of an earlier state</source>
        <translation> · eines früheren Stands</translation>
    </message>
    <message>
        <source>set the f-number</source>
        <translation>Blendenzahl setzen</translation>
    </message>
    <message>
        <source>go to a place of the sweep</source>
        <translation>zu einer Stelle des Durchlaufs gehen</translation>
    </message>
    <message>
        <source>Export the Sweep</source>
        <translation>Durchlauf exportieren</translation>
    </message>
    <message>
        <source>Tables (*.csv)</source>
        <translation>Tabellen (*.csv)</translation>
    </message>
    <message>
        <source>Stop</source>
        <comment>the sweep</comment>
        <translation>Anhalten</translation>
    </message>
</context>
<context>
    <name>ghostlight::SweepView</name>
    <message>
        <source>flux on the sensor, mm²</source>
        <translation>Fluss auf dem Sensor, mm²</translation>
    </message>
    <message>
        <source>peak, E0</source>
        <translation>Spitze, E0</translation>
    </message>
    <message>
        <source>flux, mm²</source>
        <translation>Fluss, mm²</translation>
    </message>
    <message>
        <source>Flares and ghosts while one number runs through its range.
Name it above and press Sweep.</source>
        <translation>Reflexbilder und Reflexe, während eine Zahl durch ihren Bereich läuft.
Oben benennen und Durchlauf drücken.</translation>
    </message>
    <message>
        <source>%1   worst at %2%3</source>
        <translation>%1   am schlimmsten bei %2%3</translation>
    </message>
    <message>
        <source>Flares and curves of the sweep</source>
        <translation>Reflexbilder und Kurven des Durchlaufs</translation>
    </message>
    <message>
        <source>A click takes a flare&apos;s value, or chooses a curve&apos;s ghost. Keys: ← → go from flare to flare, Return takes its value, ↑ ↓ choose a curve</source>
        <translation>Ein Klick nimmt den Wert eines Reflexbilds, oder wählt den Reflex einer Kurve. Tasten: ← → gehen von Bild zu Bild, Eingabe nimmt den Wert, ↑ ↓ wählen eine Kurve</translation>
    </message>
</context>
<context>
    <name>ghostlight::Tour</name>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Skip</source>
        <translation>Überspringen</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>Fertig</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Weiter</translation>
    </message>
</context>
<context>
    <name>ghostlight::Understanding</name>
    <message>
        <source>Check</source>
        <translation>Prüfung</translation>
    </message>
    <message>
        <source>Sweep</source>
        <translation>Durchlauf</translation>
    </message>
    <message>
        <source>%1 more</source>
        <translation>%1 weitere</translation>
    </message>
    <message>
        <source>take the pinned lens back</source>
        <translation>das festgehaltene Objektiv zurückholen</translation>
    </message>
    <message>
        <source>Export the Layout</source>
        <translation>Schnitt exportieren</translation>
    </message>
    <message>
        <source>Drawings (*.svg *.pdf *.png)</source>
        <translation>Zeichnungen (*.svg *.pdf *.png)</translation>
    </message>
    <message>
        <source>Check (%1)</source>
        <translation>Prüfung (%1)</translation>
    </message>
</context>
<context>
    <name>ghostlight::VeilingStrip</name>
    <message>
        <source>ISO 9358: light in the image of a small black spot over that of the bright surround, from all ghosts of two reflections at 587.56 nm, averaged over the sensor and at its middle. Barrel, dust and scatter make a real lens&apos;s higher.</source>
        <translation>ISO 9358: Licht im Bild eines kleinen schwarzen Flecks geteilt durch das der hellen Umgebung, von allen Reflexen zweier Spiegelungen bei 587.56 nm, über den Sensor gemittelt und in seiner Mitte. Fassung, Staub und Streuung machen den eines echten Objektivs höher.</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Work out</source>
        <translation>Berechnen</translation>
    </message>
    <message>
        <source>Veiling glare index  </source>
        <translation>Streulichtindex  </translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>*%1 %* of the sensor, *%2 %* at its middle</source>
        <translation>*%1 %* des Sensors, *%2 %* in seiner Mitte</translation>
    </message>
</context>
<context>
    <name>ghostlight::VtkView</name>
    <message>
        <source>drawn without OpenGL: %1</source>
        <translation>ohne OpenGL gezeichnet: %1</translation>
    </message>
    <message>
        <source>There is no picture here: %1.</source>
        <translation>Hier ist kein Bild: %1.</translation>
    </message>
</context>
</TS>
